/* SPDX-License-Identifier: MIT */
#include "access.h"

#include <stddef.h>
#include <string.h>
#include <strings.h>

static const char token_subprotocol[] = "fieldcast.token.";

bool access_is_loopback(const char *address)
{
    return strncmp(address, "127.", 4) == 0 || strcmp(address, "::1") == 0 ||
           strcmp(address, "localhost") == 0;
}

static bool is_listed(const char *const *list, const char *text, size_t length)
{
    for (; list && *list; list++) {
        if (strlen(*list) == length && strncasecmp(*list, text, length) == 0) {
            return true;
        }
    }
    return false;
}

/* Length of "host" in "host:port" or "[v6]:port"; of all where it is neither. */
static size_t host_length(const char *authority)
{
    const char *bracket = *authority == '[' ? strchr(authority, ']') : NULL;
    const char *end = bracket ? bracket + 1 : authority + strcspn(authority, ":");
    const bool is_port = *end == ':' && strspn(end + 1, "0123456789") == strlen(end + 1);

    return is_port ? (size_t)(end - authority) : strlen(authority);
}

static bool is_dotted_loopback(const char *host, size_t length)
{
    return length >= 7 && strncmp(host, "127.", 4) == 0 && strspn(host, "0123456789.") >= length;
}

static bool host_allowed(const struct access *access, const char *host)
{
    static const char *const own[] = {"localhost", "[::1]", NULL};

    if (!host) {
        return true; /* HTTP/1.0; a browser always sends one */
    }
    const size_t length = host_length(host);
    if (is_listed(access->allowed_hosts, host, length) ||
        is_listed(access->allowed_hosts, host, strlen(host))) {
        return true;
    }
    /* Elsewhere the token keeps rebinding out, and the names are the operator's. */
    return !access->loopback || is_listed(own, host, length) || is_dotted_loopback(host, length);
}

static bool origin_allowed(const struct access *access, const char *origin, const char *host)
{
    const char *authority = strstr(origin, "://");

    if (is_listed(access->allowed_origins, origin, strlen(origin))) {
        return true;
    }
    return authority && host && strcasecmp(authority + 3, host) == 0;
}

/* Pictures and scripts that a page of another site embeds are asked for without an Origin. */
static bool site_allowed(const struct access_request *request)
{
    return !request->site || request->origin || request->to_page ||
           (strcmp(request->site, "cross-site") != 0 && strcmp(request->site, "same-site") != 0);
}

/* Takes as long for every text of one length. */
static bool is_equal(const char *given, size_t length, const char *secret)
{
    const size_t wanted = strlen(secret);
    unsigned char difference = length != wanted;

    for (size_t i = 0; i < length; i++) {
        difference |= (unsigned char)given[i] ^ (unsigned char)secret[wanted ? i % wanted : 0];
    }
    return difference == 0;
}

static bool token_in_protocols(const char *list, const char *token)
{
    const size_t prefix = sizeof token_subprotocol - 1;

    while (list && *list) {
        list += strspn(list, ", \t");
        const size_t length = strcspn(list, ", \t");

        if (length > prefix && strncmp(list, token_subprotocol, prefix) == 0 &&
            is_equal(list + prefix, length - prefix, token)) {
            return true;
        }
        list += length;
    }
    return false;
}

static bool token_given(const struct access *access, const struct access_request *request)
{
    const char *authorization = request->authorization;

    if (authorization && strncasecmp(authorization, "Bearer ", 7) == 0) {
        authorization += 7 + strspn(authorization + 7, " ");
        return is_equal(authorization, strlen(authorization), access->token);
    }
    return token_in_protocols(request->protocols, access->token);
}

int access_check(const struct access *access, const struct access_request *request, bool open,
                 struct error *err)
{
    if (!host_allowed(access, request->host)) {
        error_set(err, ERROR_FORBIDDEN, "Host",
                  "this server answers to localhost; name other hosts with --allow-host");
        return 403;
    }
    if (request->origin && !origin_allowed(access, request->origin, request->host)) {
        error_set(err, ERROR_FORBIDDEN, "Origin",
                  "pages of other sites may not speak with this server; allow them with "
                  "--allow-origin");
        return 403;
    }
    if (!site_allowed(request)) {
        error_set(err, ERROR_FORBIDDEN, "Sec-Fetch-Site",
                  "pages of other sites may not embed what this server has; those that "
                  "--allow-origin names may fetch it");
        return 403;
    }
    if (access->token && !open && !token_given(access, request)) {
        error_set(err, ERROR_FORBIDDEN, "Authorization", "a valid token is required");
        return 401;
    }
    return 0;
}
