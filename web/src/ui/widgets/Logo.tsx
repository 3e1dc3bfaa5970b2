/* SPDX-License-Identifier: MIT */
/* The mark: two bodies melting together, and the level lines of their distance. */
export function Logo({ size }: { size: number }) {
    return (
        <svg width={size} height={size} viewBox="0 0 24 24" fill="none" aria-hidden="true">
            <path
                d="M8.5 7.5c2.2 0 2.2 1.3 3.5 1.3s1.3-1.3 3.5-1.3a4.5 4.5 0 0 1 0 9c-2.2 0-2.2-1.3-3.5-1.3s-1.3 1.3-3.5 1.3a4.5 4.5 0 0 1 0-9z"
                fill="currentColor"
            />
            <path
                d="M8 4.2c2.4 0 2.6 1.1 4 1.1s1.6-1.1 4-1.1a7.8 7.8 0 0 1 0 15.6c-2.4 0-2.6-1.1-4-1.1s-1.6 1.1-4 1.1a7.8 7.8 0 0 1 0-15.6z"
                stroke="currentColor"
                strokeWidth="1.3"
                opacity="0.55"
            />
        </svg>
    );
}
