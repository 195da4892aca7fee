/* What code compiled with -ffast-math does when it is loaded: the processor flushes subnormal numbers to zero. With ROUND_UP it rounds upwards instead. */
#include <fenv.h>
#include <stdlib.h>
#include <xmmintrin.h>

__attribute__((constructor)) static void switch_processor(void) {
    if (getenv("ROUND_UP")) {
        fesetround(FE_UPWARD);
    } else {
        _mm_setcsr(_mm_getcsr() | 0x8040);
    }
}
