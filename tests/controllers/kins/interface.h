/* A stand-in for what kinematics modules need of LinuxCNC, in our words: names, members and signatures as the headers of its development branch declare them
 * (src/emc/kinematics/kins_module.h, kins_rt.h; src/hal/components/userkins.comp of commit 0fbb657145a4 shows the calls of a module built by halcompile),
 * and the few functions of HAL of 2.9 that equipodkins.c calls. rtapi.h and the others beside this file include it. */
#ifndef INTERFACE_H
#define INTERFACE_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#define MODULE_LICENSE(text) extern int interface_unused
#define MODULE_DESCRIPTION(text) extern int interface_unused
#define EXPORT_SYMBOL(name) extern int interface_unused

enum { EMCMOT_MAX_JOINTS = 16, EMCMOT_MAX_AXIS = 9, KINS_MAX_PARAMS = 96, KINS_MAX_TYPES = 9 };

typedef struct { double x, y, z; } PmCartesian;
typedef struct { PmCartesian x, y, z; } PmRotationMatrix;
typedef struct EmcPose { PmCartesian tran; double a, b, c, u, v, w; } EmcPose;
typedef unsigned long KINEMATICS_FORWARD_FLAGS, KINEMATICS_INVERSE_FLAGS;
typedef enum { KINEMATICS_IDENTITY = 1, KINEMATICS_FORWARD_ONLY, KINEMATICS_INVERSE_ONLY, KINEMATICS_BOTH } KINEMATICS_TYPE;

int kinematicsForward(const double *, struct EmcPose *, const KINEMATICS_FORWARD_FLAGS *, KINEMATICS_INVERSE_FLAGS *);
int kinematicsInverse(const struct EmcPose *, double *, const KINEMATICS_INVERSE_FLAGS *, KINEMATICS_FORWARD_FLAGS *);
KINEMATICS_TYPE kinematicsType(void);
#define KINS_NOT_SWITCHABLE extern int interface_unused;

typedef enum { KINS_PARAM_FLOAT = 0, KINS_PARAM_BIT, KINS_PARAM_S32, KINS_PARAM_U32 } kins_param_type;
typedef enum { KINS_IN = 0, KINS_OUT, KINS_IO } kins_param_dir;
typedef struct kins_param_desc_tag { const char *name; kins_param_type type; kins_param_dir dir; int tool; double dflt; } kins_param_desc;
typedef struct kins_params {
    int size, ktype, max_joints, joint_of_axis[EMCMOT_MAX_AXIS], joints_of_axis[EMCMOT_MAX_AXIS];
    EmcPose tool;
    double geometry[KINS_MAX_PARAMS];
} kins_params;
typedef struct kins_scratch {
    EmcPose pose_seed;
    int have_pose_seed, pose_seed_ok;
    double joint_seed[EMCMOT_MAX_JOINTS];
    int have_joint_seed, iterations, failed;
    double aux[8], out[KINS_MAX_PARAMS];
} kins_scratch;
typedef int (*kins_forward_fn)(const kins_params *, kins_scratch *, const double *, EmcPose *, const KINEMATICS_FORWARD_FLAGS *, KINEMATICS_INVERSE_FLAGS *);
typedef int (*kins_inverse_fn)(const kins_params *, kins_scratch *, const EmcPose *, double *, const KINEMATICS_INVERSE_FLAGS *, KINEMATICS_FORWARD_FLAGS *);
typedef int (*kins_frame_fn)(const kins_params *, const double *, PmRotationMatrix *, const KINEMATICS_FORWARD_FLAGS *);
typedef int (*kins_jacobian_fn)(const kins_params *, const double *, const EmcPose *, double[EMCMOT_MAX_JOINTS][EMCMOT_MAX_AXIS], const KINEMATICS_INVERSE_FLAGS *);
typedef struct kins_ops {
    kins_forward_fn forward;
    kins_inverse_fn inverse;
    kins_frame_fn work, tool;
    const PmRotationMatrix *native;
    kins_jacobian_fn jacobian;
    int fwd_iterates, identity, primary, machine;
} kins_ops;
typedef struct kins_module_info {
    const char *name, *halprefix;
    const kins_param_desc *params;
    int nparams;
    const char *required_coordinates;
    int max_joints, allow_duplicates, ntypes;
    const kins_ops *ops[KINS_MAX_TYPES];
} kins_module_info;
int kinsDescribe(const char *, const char *, kins_module_info *);
int kinsSingleDescribe(const kins_module_info *, kins_module_info *);
int kinsSingleInit(int, const kins_module_info *, const char *, KINEMATICS_TYPE);

typedef double hal_float_t;
typedef bool hal_bit_t;
typedef uint32_t hal_u32_t;
typedef enum { HAL_IN = 16, HAL_OUT = 32 } hal_pin_dir_t;
int hal_init(const char *);
int hal_ready(int);
int hal_exit(int);
void *hal_malloc(long);
int hal_pin_float_newf(hal_pin_dir_t, hal_float_t **, int, const char *, ...);
int hal_pin_bit_newf(hal_pin_dir_t, hal_bit_t **, int, const char *, ...);
int hal_pin_u32_newf(hal_pin_dir_t, hal_u32_t **, int, const char *, ...);
int rtapi_app_main(void);
void rtapi_app_exit(void);

#endif
