/* What the C programs of this folder share: checks that count, and texts. */
#ifndef ACS_TESTS_CHECK_H
#define ACS_TESTS_CHECK_H

#include <acs/c/acs_protocol.h>

#include <stdio.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition) check((condition) != 0, #condition, __LINE__)
#define CHECK_TEXT(text, expected) check_text((text), (expected), __LINE__)

static inline void check(int holds, const char* condition, int line)
{
    if (!holds)
    {
        printf("line %d: not true: %s\n", line, condition);
        ++failures;
    }
}

static inline void check_text(acs_text text, const char* expected, int line)
{
    if (text.length != strlen(expected) || memcmp(text.data, expected, text.length) != 0
        || text.data[text.length] != '\0')
    {
        printf("line %d: \"%s\" is not \"%s\"\n", line, text.data, expected);
        ++failures;
    }
}

static inline int has(acs_text text, const char* part)
{
    return strstr(text.data, part) != NULL;
}

static inline int report(void)
{
    printf("%d failures\n", failures);
    return failures == 0 ? 0 : 1;
}

#endif
