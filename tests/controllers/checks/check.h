/* Checks, and numbers drawn at random, of the programs in this folder. */
#ifndef CHECK_H
#define CHECK_H

#include <stdio.h>

static unsigned failures, told;

static void check(int good, const char *what, unsigned number)
{
    if (!good) {
        failures += 1;
        if (told < 10) {
            told += 1;
            printf("fails: %s, case %u\n", what, number);
        }
    }
}

static unsigned state = 1;

/* Between -1 and 1. */
static double any(void)
{
    state = state * 1664525u + 1013904223u;
    return (state >> 8) / 8388608.0 - 1;
}

#endif
