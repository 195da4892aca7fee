/* Reads a design, computes lengths, all poses with their evidence, limits, and follows the pose of the machine as a control loop does.
 *
 *     cc control_loop.c $(pkg-config --cflags --libs equipod) -lm -o control_loop && ./control_loop designs/presets/bench-l16.toml
 *
 * Exit status 0: the tracked pose is the one the lengths were computed from at every step. */
#include <eqp.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static eqp_error error;

static void must(eqp_status status)
{
    if (status != EQP_STATUS_OK) {
        fprintf(stderr, "%s: %s\n", eqp_status_text(status), error.message);
        exit(1);
    }
}

static double distance(const eqp_pose *a, const eqp_pose *b)
{
    double sum = 0;
    int i;
    for (i = 0; i < 3; i++) {
        sum += (a->position[i] - b->position[i]) * (a->position[i] - b->position[i]);
    }
    return sqrt(sum);
}

int main(int count, char **arguments)
{
    eqp_design *design;
    eqp_solver *solver;
    eqp_solutions *solutions;
    eqp_tracker *tracker;
    eqp_pose home;
    eqp_free_range ranges[6];
    double lengths[6], worst = 0;
    size_t i, real = 0, certified = 0;
    int k;
    if (count != 2) {
        fprintf(stderr, "usage: %s DESIGN\n", arguments[0]);
        return 2;
    }
    must(eqp_design_load(arguments[1], &design, &error));
    must(eqp_design_home(design, &home, &error));
    must(eqp_ik(design, &home, 1, lengths, &error));
    printf("%s: lengths at home", eqp_design_name(design));
    for (k = 0; k < 6; k++) {
        printf(" %.3f", lengths[k]);
    }
    printf(" %s\n", eqp_design_units(design));

    /* once, before the loop: all poses with these lengths, and what is proved of them */
    must(eqp_solver_new(design, 1, &solver, &error));
    must(eqp_solve(solver, lengths, &solutions, &error));
    for (i = 0; i < eqp_solutions_count(solutions); i++) {
        eqp_solution solution;
        must(eqp_solutions_get(solutions, i, &solution, &error));
        real += solution.reality == EQP_REALITY_REAL;
        certified += solution.certified;
    }
    printf("%zu poses, %zu real, %zu certified, %s\n", eqp_solutions_count(solutions), real, certified,
           eqp_solutions_completeness(solutions) == EQP_COMPLETENESS_PROVED ? "proved to be all" : "not proved to be all");
    eqp_solutions_free(solutions);
    eqp_solver_free(solver);

    must(eqp_free_ranges(design, &home, ranges, &error));
    printf("free along z: %.3f down, %.3f up\n", ranges[2].back, ranges[2].forth);

    /* the loop: measured lengths in, pose out */
    must(eqp_tracker_new(design, &home, &tracker, &error));
    for (k = 1; k <= 1000; k++) {
        eqp_pose truth = home;
        eqp_track track;
        truth.position[2] += 0.5 * ranges[2].forth * sin(0.01 * k);
        must(eqp_ik(design, &truth, 1, lengths, &error));
        must(eqp_tracker_step(tracker, lengths, &track, &error));
        if (track.status != EQP_TRACK_STATUS_TRACKED) {
            fprintf(stderr, "not tracked at step %d\n", k);
            return 1;
        }
        if (distance(&track.pose, &truth) > worst) {
            worst = distance(&track.pose, &truth);
        }
    }
    printf("1000 steps tracked, greatest error %.1e\n", worst);
    eqp_tracker_free(tracker);
    eqp_design_free(design);
    return worst < 1e-6 ? 0 : 1;
}
