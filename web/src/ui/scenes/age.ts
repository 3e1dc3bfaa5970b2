/* SPDX-License-Identifier: MIT */
/* "3 hours ago" in the language of the page. */
const steps: readonly (readonly [Intl.RelativeTimeFormatUnit, number])[] = [
    ["year", 365 * 86400],
    ["month", 30 * 86400],
    ["day", 86400],
    ["hour", 3600],
    ["minute", 60],
];

/* Clocks may differ: nothing is from the future. */
export function age(time: number, now: number): string {
    const seconds = Math.max(0, Math.round((now - time) / 1000));
    const format = new Intl.RelativeTimeFormat("en", { numeric: "auto" });
    if (seconds < 45) {
        return format.format(0, "second");
    }
    const [unit, size] = steps.find(([, size]) => seconds >= size) ?? ["minute", 60];
    return format.format(-Math.round(seconds / size), unit);
}
