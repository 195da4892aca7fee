/* Start of a Cortex-M4 or M7 with floating point unit in QEMU's MPS2 machines: what the processor needs before main, and semihosting. */
#include <stdint.h>
#include <stdlib.h>

extern uint32_t stack_top;
extern int main(void);
extern void initialise_monitor_handles(void);
void reset(void);
void fault(void);

__attribute__((section(".vectors"), used)) static void *const vectors[] = {&stack_top, (void *)reset, (void *)fault, (void *)fault, (void *)fault, (void *)fault, (void *)fault};

void fault(void)
{
    _Exit(99);
}

void reset(void)
{
    *(volatile uint32_t *)0xe000ed88 |= 0xfu << 20; /* full access to the floating point unit */
    __asm__ volatile("dsb\n isb");
    initialise_monitor_handles();
    exit(main());
}

/* newlib's exit calls them; there is nothing to do */
void _init(void);
void _fini(void);
void _init(void) {}
void _fini(void) {}
