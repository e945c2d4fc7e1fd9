/* The C tests' few words: say what is protected, expect, and sum up. */
#ifndef TESTS_EXPECT_H
#define TESTS_EXPECT_H
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <striae.h>

static int expect_count, expect_failures;

static inline void protects(const char *what) { printf("protects: %s\n", what); }

static inline bool expect_at(bool holds, const char *what, const char *file, int line) {
    expect_count++;
    if (!holds) {
        expect_failures++;
        printf("%s:%d: expected %s\n", file, line, what);
    }
    return holds;
}

/* Refused, with a text that names the argument, the value and what is accepted. */
static inline void expect_refused_at(StriaeStatus status, const char *argument, const char *value, const char *call,
                                     const char *file, int line) {
    const char *text = striae_last_error();
    bool good = status == STRIAE_STATUS_INVALID_ARGUMENT;
    good = good && strstr(text, argument) && strstr(text, value) && strstr(text, "accepted");
    expect_count++;
    if (!good) {
        expect_failures++;
        printf("%s:%d: %s\n    gave status %d and \"%s\"\n    expected INVALID_ARGUMENT and \"%s\", \"%s\", "
               "\"accepted\"\n",
               file, line, call, (int)status, text, argument, value);
    }
}

#define EXPECT(condition) expect_at((condition), #condition, __FILE__, __LINE__)
#define EXPECT_OK(call)                                                                                            \
    do {                                                                                                           \
        const StriaeStatus status_ = (call);                                                                       \
        if (!expect_at(status_ == STRIAE_STATUS_OK, #call " to succeed", __FILE__, __LINE__))                      \
            printf("    it gave status %d and \"%s\"\n", (int)status_, striae_last_error());                       \
    } while (0)
#define EXPECT_REFUSED(call, argument, value) expect_refused_at((call), argument, value, #call, __FILE__, __LINE__)

static inline void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    if (!EXPECT(file != NULL)) return;
    fputs(text, file);
    fclose(file);
}

static inline int expect_summary(void) {
    printf("%d expectations, %d failed\n", expect_count, expect_failures);
    return expect_failures == 0 && expect_count > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
#endif
