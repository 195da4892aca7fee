"""From the octahedral platform of the paper to a platform without shared joints, with its leg map and the proof that both have the same poses."""

import equipod

design = equipod.Design.load("designs/rbt-octahedral.toml")
free = design.equivalent([0.2, 0.21, 0.22, 0.2, 0.2, 0.23])
print(free.design)
print("A =", free.A.round(4), sep="\n")
print("c =", free.c.round(4))

answer = equipod.verify(design, free.design, samples=4)
print(answer.verdict, "-", answer.explanation)

# the lengths of the new machine at a pose, from those of the octahedral one
pose = equipod.pose([0.4, -0.3, 17.0], rpy=[3, -2, 10], degrees=True)
lengths = design.ik(pose)
mapped = equipod.leg_map(design, free.design).lengths(lengths)
print("largest difference from inverse kinematics:", float(abs(mapped - free.design.ik(pose)).max()))
