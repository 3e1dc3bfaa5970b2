/* SPDX-License-Identifier: MIT */
/* Writing JSON: numbers and strings as ECMAScript's JSON.stringify writes them, so that the web
 * client and the server give the same bytes. */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "memory.h"

enum { LINE_WIDTH = 96, MILLION_DIGITS = 6 };
#define MILLION 1e6

struct text {
    char *bytes;
    size_t length, capacity;
    bool pretty;
};

static void add(struct text *text, const char *bytes, size_t length)
{
    if (text->length + length + 1 > text->capacity) {
        text->capacity = 2 * text->capacity + length + 256;
        text->bytes = memory_resize(text->bytes, text->capacity, 1);
    }
    memcpy(text->bytes + text->length, bytes, length);
    text->length += length;
    text->bytes[text->length] = '\0';
}

static void add_text(struct text *text, const char *bytes)
{
    add(text, bytes, strlen(bytes));
}

/* --- numbers --- */

struct decimal {
    char digits[20];
    int count;
    int point; /* value = 0.DIGITS * 10^point */
};

/* Digits of a whole number; returns how many. */
static int put_digits(uint64_t number, char *out)
{
    char reversed[20];
    int count = 0;

    do {
        reversed[count++] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    for (int i = 0; i < count; i++) {
        out[i] = reversed[count - 1 - i];
    }
    return count;
}

/* Most numbers are a few millionths. A decimal of so few digits that reads back as the value is the
 * only one, and dividing two exact numbers rounds as reading does. */
static bool millionths(double value, struct decimal *out)
{
    const double number = nearbyint(value * MILLION);

    if (number < 1 || number > MILLION * MILLION || number / MILLION != value) {
        return false;
    }
    out->count = put_digits((uint64_t)number, out->digits);
    out->point = out->count - MILLION_DIGITS;
    while (out->digits[out->count - 1] == '0') {
        out->count--;
    }
    return true;
}

/* The fewest digits that read back as `value`: a normal double keeps any 15, and %e pads with
 * zeros, so fewer need not be tried. */
static struct decimal shortest_decimal(double value)
{
    struct decimal decimal = {.count = 0};
    char text[40];

    if (millionths(value, &decimal)) {
        return decimal;
    }
    for (int digits = value < DBL_MIN ? 1 : 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*e", digits - 1, value);
        if (strtod(text, NULL) == value) {
            break;
        }
    }
    char *exponent = strchr(text, 'e');
    for (char *c = text; c < exponent; c++) {
        if (*c >= '0' && *c <= '9') { /* skips the point, whatever the locale calls it */
            decimal.digits[decimal.count++] = *c;
        }
    }
    while (decimal.count > 1 && decimal.digits[decimal.count - 1] == '0') {
        decimal.count--;
    }
    decimal.point = atoi(exponent + 1) + 1;
    return decimal;
}

/* Number::toString of ECMA-262; RFC 8785 writes numbers the same way. */
void json_number(double value, char out[32])
{
    if (!isfinite(value) || value == 0) {
        strcpy(out, value == 0 ? "0" : "null");
        return;
    }
    struct decimal d = shortest_decimal(fabs(value));
    const char *sign = value < 0 ? "-" : "";
    if (d.point > 21 || d.point < -5) {
        const int exponent = d.point - 1;
        snprintf(out, 32, "%s%c%s%.*se%c%d", sign, d.digits[0], d.count > 1 ? "." : "", d.count - 1,
                 d.digits + 1, exponent < 0 ? '-' : '+', abs(exponent));
    } else if (d.point <= 0) {
        snprintf(out, 32, "%s0.%.*s%.*s", sign, -d.point, "00000", d.count, d.digits);
    } else if (d.count <= d.point) {
        snprintf(out, 32, "%s%.*s%.*s", sign, d.count, d.digits, d.point - d.count,
                 "00000000000000000000");
    } else {
        snprintf(out, 32, "%s%.*s.%.*s", sign, d.point, d.digits, d.count - d.point,
                 d.digits + d.point);
    }
}

static void add_number(struct text *text, double value)
{
    char out[32];

    if (fabs(value) < 1e6 && value == trunc(value)) {
        const int sign = value < 0;
        out[0] = '-';
        out[sign + put_digits((uint64_t)fabs(value), out + sign)] = '\0';
    } else {
        json_number(value, out);
    }
    add_text(text, out);
}

/* --- strings --- */

static void add_string(struct text *text, const char *string)
{
    static const char names[] = "\"\\bfnrt", meanings[] = "\"\\\b\f\n\r\t";

    add(text, "\"", 1);
    for (const char *c = string; *c;) {
        size_t plain = 0;
        while ((unsigned char)c[plain] >= 0x20 && c[plain] != '"' && c[plain] != '\\') {
            plain++;
        }
        add(text, c, plain);
        c += plain;
        if (*c) {
            char escape[8];
            const char *meaning = strchr(meanings, *c);
            if (meaning) {
                snprintf(escape, sizeof escape, "\\%c", names[meaning - meanings]);
            } else {
                snprintf(escape, sizeof escape, "\\u%04x", (unsigned char)*c);
            }
            add_text(text, escape);
            c++;
        }
    }
    add(text, "\"", 1);
}

/* --- containers --- */

static bool is_container(const cJSON *json)
{
    return cJSON_IsObject(json) || cJSON_IsArray(json);
}

/* At most arrays of scalars inside: may stand on one line. */
static bool is_flat(const cJSON *json)
{
    for (const cJSON *item = json->child; item; item = item->next) {
        if (cJSON_IsObject(item)) {
            return false;
        }
        for (const cJSON *part = item->child; part; part = part->next) {
            if (is_container(part)) {
                return false;
            }
        }
    }
    return true;
}

static void add_value(struct text *text, const cJSON *json, int indent);

static void add_indent(struct text *text, int indent)
{
    add(text, "\n", 1);
    for (int i = 0; i < indent; i++) {
        add(text, "  ", 2);
    }
}

static void add_items(struct text *text, const cJSON *json, int indent, bool broken)
{
    const bool object = cJSON_IsObject(json);

    add(text, object ? "{" : "[", 1);
    for (const cJSON *item = json->child; item; item = item->next) {
        if (item != json->child) {
            add_text(text, text->pretty && !broken ? ", " : ",");
        }
        if (broken) {
            add_indent(text, indent + 1);
        }
        if (object) {
            add_string(text, item->string);
            add_text(text, text->pretty ? ": " : ":");
        }
        add_value(text, item, indent + 1);
    }
    if (broken) {
        add_indent(text, indent);
    }
    add(text, object ? "}" : "]", 1);
}

static void add_container(struct text *text, const cJSON *json, int indent)
{
    if (!text->pretty || !json->child) {
        add_items(text, json, indent, false);
        return;
    }
    if (is_flat(json)) {
        const size_t start = text->length;
        add_items(text, json, indent, false);
        if (text->length - start + 2 * (size_t)indent <= LINE_WIDTH) {
            return;
        }
        text->length = start;
    }
    add_items(text, json, indent, true);
}

static void add_value(struct text *text, const cJSON *json, int indent)
{
    if (is_container(json)) {
        add_container(text, json, indent);
    } else if (cJSON_IsString(json)) {
        add_string(text, json->valuestring);
    } else if (cJSON_IsNumber(json)) {
        add_number(text, json->valuedouble);
    } else if (cJSON_IsRaw(json)) {
        add_text(text, json->valuestring);
    } else {
        add_text(text, cJSON_IsTrue(json) ? "true" : cJSON_IsFalse(json) ? "false" : "null");
    }
}

char *json_print(const cJSON *json, bool pretty)
{
    struct text text = {.pretty = pretty};

    add_value(&text, json, 0);
    if (pretty) {
        add(&text, "\n", 1);
    }
    return text.bytes;
}
