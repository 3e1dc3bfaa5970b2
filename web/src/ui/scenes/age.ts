/* SPDX-License-Identifier: MIT */
/* "3 hours ago" in the language of the page. */
const steps: readonly (readonly [Intl.RelativeTimeFormatUnit, number])[] = [
    ["year", 365 * 86400],
    ["month", 30 * 86400],
    ["day", 86400],
    ["hour", 3600],
    ["minute", 60],
    ["second", 1],
];

export function age(time: number, now = Date.now()): string {
    const seconds = Math.round((time - now) / 1000);
    const format = new Intl.RelativeTimeFormat("en", { numeric: "auto" });
    if (Math.abs(seconds) < 45) {
        return format.format(0, "second");
    }
    const [unit, size] = steps.find(([, size]) => Math.abs(seconds) >= size) ?? ["second", 1];
    return format.format(Math.round(seconds / size), unit);
}
