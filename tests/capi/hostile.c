/* What no program should pass to the C interface: null places, numbers that are none, threads and designs that are freed early. Exit 0: each
 * call has its code. Under valgrind nothing is left. */
#include <eqp.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static int failures;

static void check(enum eqp_status status, enum eqp_status expected, const char *what, const struct eqp_error *error)
{
    if (status != expected) {
        failures += 1;
        printf("%s: %s (%s), expected %s\n", what, eqp_status_text(status), error->message, eqp_status_text(expected));
    }
}

int main(int count, char **words)
{
    static const char text[] = "\xff\xfe";
    struct eqp_error e;
    struct eqp_design *design = 0;
    struct eqp_solver *solver = 0;
    struct eqp_solutions *solutions = 0;
    struct eqp_tracker *tracker = 0;
    struct eqp_track track;
    struct eqp_pose home, other;
    double lengths[6], rows[36], bad[6];
    int i;
    if (count < 2) {
        return 2;
    }
    memset(&e, 0, sizeof e);
    check(eqp_design_load(0, &design, &e), EQP_STATUS_BAD_POINTER, "a null path", &e);
    check(eqp_design_load(words[1], 0, &e), EQP_STATUS_BAD_POINTER, "a null place for a design", &e);
    check(eqp_design_load(words[1], 0, 0), EQP_STATUS_BAD_POINTER, "null places for design and error", &e);
    check(eqp_design_from_toml(0, 10, &design, &e), EQP_STATUS_BAD_POINTER, "a null text", &e);
    check(eqp_design_from_toml("x", SIZE_MAX, &design, &e), EQP_STATUS_BAD_POINTER, "a length that is none", &e);
    check(eqp_design_from_toml(text, 2, &design, &e), EQP_STATUS_BAD_TEXT, "no UTF-8", &e);
    check(eqp_design_load(words[1], &design, &e), EQP_STATUS_OK, "a design", &e);
    check(eqp_design_home(design, 0, &e), EQP_STATUS_BAD_POINTER, "a null place for a pose", &e);
    check(eqp_design_home(design, &home, &e), EQP_STATUS_OK, "home", &e);
    check(eqp_ik(design, &home, 1, lengths, &e), EQP_STATUS_OK, "lengths", &e);
    check(eqp_ik(0, &home, 1, lengths, &e), EQP_STATUS_BAD_POINTER, "a null design", &e);
    other = home;
    other.position[0] = NAN;
    check(eqp_ik(design, &other, 1, rows, &e), EQP_STATUS_BAD_POSE, "a pose that is none", &e);
    check(eqp_jacobian(design, &home, 0, rows, &e), EQP_STATUS_BAD_LENGTHS, "a characteristic length of 0", &e);
    check(eqp_jacobian(design, &home, NAN, rows, &e), EQP_STATUS_BAD_LENGTHS, "a characteristic length that is no number", &e);
    check(eqp_jacobian(design, &home, 1, 0, &e), EQP_STATUS_BAD_POINTER, "a null place for rows", &e);
    check(eqp_jacobian(design, &home, 1, rows, &e), EQP_STATUS_OK, "a Jacobian", &e);
    check(eqp_solver_new(design, 1, 0, &e), EQP_STATUS_BAD_POINTER, "a null place for a solver", &e);
    check(eqp_solver_new(design, 1, &solver, &e), EQP_STATUS_OK, "a solver", &e);
    check(eqp_tracker_new(design, &home, 0, &e), EQP_STATUS_BAD_POINTER, "a null place for a tracker", &e);
    check(eqp_tracker_new(design, &home, &tracker, &e), EQP_STATUS_OK, "a tracker", &e);
    eqp_design_free(design);
    check(eqp_tracker_step(tracker, lengths, 0, &e), EQP_STATUS_BAD_POINTER, "a null place for a step", &e);
    for (i = 0; i < 6; i++) {
        bad[i] = NAN;
    }
    check(eqp_tracker_step(tracker, bad, &track, &e), EQP_STATUS_BAD_LENGTHS, "a step to lengths that are none", &e);
    check(eqp_tracker_step(tracker, lengths, &track, &e), EQP_STATUS_OK, "a step after the design was freed", &e);
    eqp_tracker_free(tracker);
    eqp_tracker_free(0);
    check(eqp_solve(solver, lengths, 0, &e), EQP_STATUS_BAD_POINTER, "a null place for poses", &e);
    check(eqp_solve(solver, bad, &solutions, &e), EQP_STATUS_BAD_LENGTHS, "poses of lengths that are none", &e);
    eqp_solutions_free(solutions);
    eqp_solver_free(solver);
    printf("hostile calls: %d failed\n", failures);
    return failures != 0;
}
