/* C interface of equipod: leg lengths, poses, limits of Gough-Stewart platforms. Made by cbindgen from src/app/capi; docs/c-interface.md explains it. */

#ifndef EQP_H
#define EQP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/*
 Bytes of the message of an error, the zero at its end included.
 */
#define EQP_MESSAGE 1024

/*
 What became of a call.
 */
typedef enum eqp_status {
    /*
     Done.
     */
    EQP_STATUS_OK = 0,
    /*
     A pointer is null that must not be, or a number of items is too large.
     */
    EQP_STATUS_BAD_POINTER = 1,
    /*
     A text is not UTF-8.
     */
    EQP_STATUS_BAD_TEXT = 2,
    /*
     The text of a design is refused; all that is wrong with it is in the message.
     */
    EQP_STATUS_BAD_DESIGN = 3,
    /*
     A file cannot be read.
     */
    EQP_STATUS_FILE = 4,
    /*
     Joints and legs that make no platform.
     */
    EQP_STATUS_BAD_JOINTS = 5,
    /*
     Values that are no leg lengths, or a characteristic length that is not positive and finite.
     */
    EQP_STATUS_BAD_LENGTHS = 6,
    /*
     Numbers that are no pose.
     */
    EQP_STATUS_BAD_POSE = 7,
    /*
     A pose so far away that lengths overflow.
     */
    EQP_STATUS_OVERFLOW = 8,
    /*
     No pose was found that meets the requirements.
     */
    EQP_STATUS_NO_ALLOWED_POSE = 9,
    /*
     An index beyond the number of items.
     */
    EQP_STATUS_BAD_INDEX = 10,
    /*
     A computation that broke down, or a leg of length zero, which has no direction.
     */
    EQP_STATUS_COMPUTATION = 11,
    /*
     A fault of the library.
     */
    EQP_STATUS_INTERNAL = 12,
    /*
     The legs of a design are rods on cranks: functions for them are in the C of `equipod export DESIGN --to c`.
     */
    EQP_STATUS_CRANKS = 13,
} eqp_status;

/*
 Whether a list of poses is all of them.
 */
typedef enum eqp_completeness {
    /*
     Nothing is known.
     */
    EQP_COMPLETENESS_UNPROVED = 0,
    /*
     As many as there are, counted modulo random primes: wrong with a probability that the library bounds.
     */
    EQP_COMPLETENESS_MODULAR = 1,
    /*
     As many as a theorem allows.
     */
    EQP_COMPLETENESS_PROVED = 2,
    /*
     All poses up to a distance, so all real ones, by a theorem; others are proved to be farther out.
     */
    EQP_COMPLETENESS_PROVED_BOUNDED = 3,
} eqp_completeness;

/*
 Whether a pose is real.
 */
typedef enum eqp_reality {
    /*
     It is not.
     */
    EQP_REALITY_COMPLEX = 0,
    /*
     It is.
     */
    EQP_REALITY_REAL = 1,
    /*
     Not decided.
     */
    EQP_REALITY_UNDECIDED = 2,
} eqp_reality;

/*
 What became of a step.
 */
typedef enum eqp_track_status {
    /*
     The pose continues the last one, joined to it by regular poses: no other assembly mode was taken.
     */
    EQP_TRACK_STATUS_TRACKED = 0,
    /*
     A singular pose lies on the way or at its end.
     */
    EQP_TRACK_STATUS_NEAR_SINGULAR = 1,
    /*
     Given up: the lengths are too far from the last ones, or rounding keeps Newton's method from the accuracy that the test needs.
     */
    EQP_TRACK_STATUS_LOST = 2,
} eqp_track_status;

/*
 A design. It does not change: threads may share it.
 */
typedef struct eqp_design eqp_design;

/*
 All finite poses for one row of lengths, real ones first.
 */
typedef struct eqp_solutions eqp_solutions;

/*
 A design prepared for many lengths. It does not change: threads may share it.
 */
typedef struct eqp_solver eqp_solver;

/*
 Follows the pose of a machine. It belongs to one thread at a time; a step takes a few microseconds and allocates nothing.
 */
typedef struct eqp_tracker eqp_tracker;

/*
 What went wrong, in words. The caller owns it; a null pointer in its place says that no words are wanted.
 */
typedef struct eqp_error {
    /*
     The outcome of the call.
     */
    enum eqp_status status;
    /*
     UTF-8 that ends with a zero; cut where it is longer, empty where all is well.
     */
    char message[EQP_MESSAGE];
} eqp_error;

/*
 A pose: a platform point `x` is at `R x + p` in the base frame.
 */
typedef struct eqp_pose {
    /*
     `R`, row by row.
     */
    double rotation[3][3];
    /*
     `p`, design units.
     */
    double position[3];
} eqp_pose;

/*
 How far one of the six numbers of a pose (x, y, z in design units; roll, pitch, yaw in degrees) may move while the others stay.
 */
typedef struct eqp_free_range {
    /*
     Towards smaller values, not negative.
     */
    double back;
    /*
     Towards greater ones.
     */
    double forth;
    /*
     Whether something binds there; else nothing does within half a turn, or ten sizes of the design.
     */
    bool back_binds;
    /*
     The same of the greater values.
     */
    bool forth_binds;
} eqp_free_range;

/*
 An allowed pose near one that may not be.
 */
typedef struct eqp_nearest {
    /*
     The pose.
     */
    struct eqp_pose pose;
    /*
     `sqrt(|p - p'|^2 + (L angle)^2)` from the one asked for, `L` the characteristic length of the design; 0 where that one is allowed.
     */
    double distance;
    /*
     Whether it is locally nearest, as far as margins are smooth.
     */
    bool stationary;
    /*
     Whether the straight way from home to it violates nothing.
     */
    bool straight_from_home;
} eqp_nearest;

/*
 A pose with its evidence.
 */
typedef struct eqp_solution {
    /*
     Real part of `R`, row by row.
     */
    double rotation[3][3];
    /*
     Real part of `p`, design units.
     */
    double position[3];
    /*
     Imaginary part of `R`, zero where the pose is real.
     */
    double rotation_imaginary[3][3];
    /*
     Imaginary part of `p`.
     */
    double position_imaginary[3];
    /*
     Whether it is real.
     */
    enum eqp_reality reality;
    /*
     Whether a proof in interval arithmetic says that there is such a pose near these numbers.
     */
    bool certified;
    /*
     Bound on the distance of every entry of `R` from that of the pose proved; infinite without a certificate.
     */
    double rotation_error;
    /*
     The same of `p`, design units.
     */
    double position_error;
    /*
     How often it counts.
     */
    uint32_t multiplicity;
    /*
     Largest error of the leg equations over the squared size of the design.
     */
    double residual;
} eqp_solution;

/*
 A step with its evidence.
 */
typedef struct eqp_track {
    /*
     What became of it.
     */
    enum eqp_track_status status;
    /*
     The pose for the lengths where it was tracked, else the last one on the way to them.
     */
    struct eqp_pose pose;
    /*
     How far on the straight line of squared lengths, from 0 to 1.
     */
    double fraction;
    /*
     Largest error of the leg equations at the pose over the squared size of the design.
     */
    double residual;
    /*
     `6 / (|J| |J^-1|)` at the pose: 1 at best, 0 at a singular pose.
     */
    double frobenius_ratio;
    /*
     Newton steps.
     */
    uint32_t newton_steps;
} eqp_track;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 The version of the library, `major.minor.patch`: a text that stays.
 */
const char *eqp_version(void);

/*
 Reads the text of a design file, TOML, of `length` bytes.

 # Safety
 `text` points to `length` bytes, `design` to a place for a pointer, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_design_from_toml(const char *text,
                                     size_t length,
                                     struct eqp_design **design,
                                     struct eqp_error *error);

/*
 Reads the text of a design file, JSON, of `length` bytes.

 # Safety
 As `eqp_design_from_toml`.
 */
enum eqp_status eqp_design_from_json(const char *text,
                                     size_t length,
                                     struct eqp_design **design,
                                     struct eqp_error *error);

/*
 Reads a design file; `path` ends with a zero and is UTF-8.

 # Safety
 `path` points to a text that ends with a zero, `design` to a place for a pointer, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_design_load(const char *path,
                                struct eqp_design **design,
                                struct eqp_error *error);

/*
 A design from the ends of its six legs: base joints in the base frame, platform joints in the platform frame, in leg order. Its home is worked out, and nothing limits it.

 # Safety
 `base` and `platform` point to six points of three numbers, `design` to a place for a pointer, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_design_from_joints(const double *base,
                                       const double *platform,
                                       struct eqp_design **design,
                                       struct eqp_error *error);

/*
 Frees a design; null is nothing. What was made from it stays.

 # Safety
 `design` is null or a design that was not freed.
 */
void eqp_design_free(struct eqp_design *design);

/*
 The name of a design, which lives as long as it; null for null.

 # Safety
 `design` is null or a design.
 */
const char *eqp_design_name(const struct eqp_design *design);

/*
 The unit of lengths of a design, which lives as long as it; null for null.

 # Safety
 `design` is null or a design.
 */
const char *eqp_design_units(const struct eqp_design *design);

/*
 The home pose of a design, above the base where it names none.

 # Safety
 `design` is a design, `pose` points to a place for a pose, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_design_home(const struct eqp_design *design, struct eqp_pose *pose, struct eqp_error *error);

/*
 Inverse kinematics: six lengths for each of `count` poses.

 # Safety
 `design` is a design, `poses` points to `count` poses, `lengths` to places for `count` rows of six numbers, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_ik(const struct eqp_design *design,
                       const struct eqp_pose *poses,
                       size_t count,
                       double *lengths,
                       struct eqp_error *error);

/*
 The Jacobian at a pose, row `i` `[u_i, ((R b_i) x u_i) / L]`: speed of leg `i` from the velocity of the platform origin and the angular velocity times `L`, base frame.
 `EQP_STATUS_BAD_LENGTHS` where the characteristic length `L` is not positive and finite, `EQP_STATUS_COMPUTATION` where a leg has length zero.

 # Safety
 `design` is a design, `pose` points to a pose, `rows` to places for six rows of six numbers, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_jacobian(const struct eqp_design *design,
                             const struct eqp_pose *pose,
                             double characteristic_length,
                             double *rows,
                             struct eqp_error *error);

/*
 What a code means, a text that stays; for a number that is no code it says so.
 */
const char *eqp_status_text(int32_t status);

/*
 Whether a pose meets every requirement of the design, and `det J` has the sign that it has at home.

 # Safety
 `design` is a design, `pose` points to a pose, `allowed` to a place for the answer, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_allowed(const struct eqp_design *design,
                            const struct eqp_pose *pose,
                            bool *allowed,
                            struct eqp_error *error);

/*
 How far x, y, z, roll, pitch and yaw of a pose may move, each alone; `EQP_STATUS_NO_ALLOWED_POSE` where the pose itself is not allowed.

 # Safety
 `design` is a design, `pose` points to a pose, `ranges` to places for six ranges, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_free_ranges(const struct eqp_design *design,
                                const struct eqp_pose *pose,
                                struct eqp_free_range *ranges,
                                struct eqp_error *error);

/*
 A pose locally nearest to `asked` among those that meet every requirement; `asked` itself where it does.

 # Safety
 `design` is a design, `asked` points to a pose, `nearest` to a place for the answer, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_nearest_allowed(const struct eqp_design *design,
                                    const struct eqp_pose *asked,
                                    uint64_t seed,
                                    struct eqp_nearest *nearest,
                                    struct eqp_error *error);

/*
 The pose at a position with the roll, pitch and yaw given, degrees: `R = Rz(yaw) Ry(pitch) Rx(roll)`.

 # Safety
 `position` and `rpy_deg` point to three numbers each, `pose` to a place for a pose, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_pose_from_rpy(const double *position,
                                  const double *rpy_deg,
                                  struct eqp_pose *pose,
                                  struct eqp_error *error);

/*
 Roll, pitch and yaw of a pose, degrees.

 # Safety
 `pose` points to a pose, `rpy_deg` to places for three numbers, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_pose_rpy(const struct eqp_pose *pose, double *rpy_deg, struct eqp_error *error);

/*
 Prepares a design; the solver does not need the design afterwards. The same seed gives the same answers.

 # Safety
 `design` is a design, `solver` points to a place for a pointer, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_solver_new(const struct eqp_design *design,
                               uint64_t seed,
                               struct eqp_solver **solver,
                               struct eqp_error *error);

/*
 Frees a solver; null is nothing.

 # Safety
 `solver` is null or a solver that was not freed.
 */
void eqp_solver_free(struct eqp_solver *solver);

/*
 All finite poses, real and complex, for six lengths.

 # Safety
 `solver` is a solver, `lengths` points to six numbers, `solutions` to a place for a pointer, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_solve(const struct eqp_solver *solver,
                          const double *lengths,
                          struct eqp_solutions **solutions,
                          struct eqp_error *error);

/*
 All finite poses for each of `count` rows of lengths, computed by up to `threads` threads, 0 for as many as there are processors. A row that fails has a null pointer in `solutions`, and its code in
 `statuses`, which may be null; the others are as they are alone. Returns the first code that is not `EQP_STATUS_OK`, with its message.

 # Safety
 `solver` is a solver, `lengths` points to `count` rows of six numbers, `solutions` to places for `count` pointers, `statuses` is null or points to places for `count` codes, `error` is null or points to a place for
 an error.
 */
enum eqp_status eqp_solve_all(const struct eqp_solver *solver,
                              const double *lengths,
                              size_t count,
                              size_t threads,
                              struct eqp_solutions **solutions,
                              enum eqp_status *statuses,
                              struct eqp_error *error);

/*
 Frees a list of poses; null is nothing.

 # Safety
 `solutions` is null or a list that was not freed.
 */
void eqp_solutions_free(struct eqp_solutions *solutions);

/*
 How many poses a list has; 0 for null.

 # Safety
 `solutions` is null or a list.
 */
size_t eqp_solutions_count(const struct eqp_solutions *solutions);

/*
 Whether a list is all poses that there are; `EQP_COMPLETENESS_UNPROVED` for null.

 # Safety
 `solutions` is null or a list.
 */
enum eqp_completeness eqp_solutions_completeness(const struct eqp_solutions *solutions);

/*
 A pose of a list, counted from 0.

 # Safety
 `solutions` is a list, `solution` points to a place for a pose with its evidence, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_solutions_get(const struct eqp_solutions *solutions,
                                  size_t index,
                                  struct eqp_solution *solution,
                                  struct eqp_error *error);

/*
 A tracker that begins at a pose; it does not need the design afterwards.

 # Safety
 `design` is a design, `start` points to a pose, `tracker` to a place for a pointer, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_tracker_new(const struct eqp_design *design,
                                const struct eqp_pose *start,
                                struct eqp_tracker **tracker,
                                struct eqp_error *error);

/*
 Continues the pose to six lengths. Where it is not tracked the tracker stays where it was, and the call is `EQP_STATUS_OK` all the same: `track` says what became of it.

 # Safety
 `tracker` is a tracker that no other thread uses meanwhile, `lengths` points to six numbers, `track` to a place for the answer, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_tracker_step(struct eqp_tracker *tracker,
                                 const double *lengths,
                                 struct eqp_track *track,
                                 struct eqp_error *error);

/*
 Where the platform is.

 # Safety
 `tracker` is a tracker that no other thread steps meanwhile, `pose` points to a place for a pose, `error` is null or points to a place for an error.
 */
enum eqp_status eqp_tracker_pose(const struct eqp_tracker *tracker,
                                 struct eqp_pose *pose,
                                 struct eqp_error *error);

/*
 Frees a tracker; null is nothing.

 # Safety
 `tracker` is null or a tracker that was not freed.
 */
void eqp_tracker_free(struct eqp_tracker *tracker);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* EQP_H */
