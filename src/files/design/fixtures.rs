//! Texts of designs for tests, which spoil them by replacements.

/// From the legs to the home pose.
macro_rules! octahedral {
    () => {
        r#"legs = [["P1", "P4"], ["P2", "P4"], ["P2", "P5"], ["P3", "P5"], ["P3", "P6"], ["P1", "P6"]]
[base]
P1 = [0, 0, 0]
P2 = [6.0, 10.392304845413264, 0.0]
P3 = [12.0, 0.0, 0.0]
[platform]
P4 = [0.0, 0.0, 0.0]
P5 = [6.0, 0.0, 0.0]
P6 = [3.0, -5.196152422706632, 0.0]
[home]
position = [3.0, 5.0, 8.0]
rpy_deg = [0.0, 0.0, 90.0]
"#
    };
}

/// An octahedral design with lengths and a line in each of the tables home, workspace, optimize, hardware.
pub(super) const PLAIN: &str = concat!(
    r#"name = "octahedral"
units = "mm"
lengths = [9, 9, 9.0, 9, 9, 9]
"#,
    octahedral!(),
    r"[workspace]
translation = [1, 1, 1]
[optimize]
min_abs_det = 0.1
[hardware]
joint_diameter = 0.5
"
);

/// The same geometry with all tables of requirements.
pub(super) const REQUIRED: &str = concat!(
    r#"name = "bench"
units = "mm"
"#,
    octahedral!(),
    r#"[workspace]
translation = [1, 1, 1]
region = "ellipsoid"
trajectory = "path.csv"
[hardware]
joint_diameter = 0.5
base_housing = [1, 2, 3]
leg_diameter = 0.4
rod_diameter = 0.2
cylinder_length = 5
leg_clearance = 0
dead_length = 4
stroke = 3
base_cone_angle_deg = 45
base_axes = [[0, 0, 1], [0, 0, 2], [1, 1, 1], [0, 3, 4], [0.1, 0.2, 0.3], [7, 1, 2]]
platform_cone_angle_deg = 60
platform_axes = "optimize"
max_leg_force = 500
max_leg_speed = 30
leg_stiffness = 1e5
cylinder_mass = 3
cylinder_center = 2.5
rod_mass = 1
rod_center = 1.5
rod_inertia = 0.9
reflected_mass = 4
[speed]
linear = 20
angular_deg = 45
[[loads]]
name = "weight"
force = [0, 0, -100]
[[loads]]
torque = [1, 2, 3]
at = [0, 0, 5]
fixed_to = "platform"
[[keep_out]]
name = "table"
box = { center = [0, 0, -5], size = [40, 40, 1] }
[[keep_out]]
fixed_to = "platform"
sphere = { center = [0, 0, 2], diameter = 3 }
[[keep_out]]
capsule = { from = [0, 0, 0], to = [0, 0, 2], diameter = 3 }
[calibration]
offsets = [0.1, -0.2, 0, 0.05, 1e-3, 0.25]
offset_deviations = [0.01, 0.01, 0.02, 0.01, 0.01, 0.03]
[calibration.base_deviations]
P1 = [0.1, 0.2, 0.3]
P3 = [0, 0.2, 0.3]
[calibration.platform_deviations]
P4 = [0.01, 0.02, 0.03]
[calibration.correlations]
unknowns = ["base.P1.x", "platform.P4.z", "offset.6"]
matrix = [[1], [0.5, 1], [0.25, 0.75, 1]]
[stiffness]
linear = 2e4
angular = 3e5
"#
);
