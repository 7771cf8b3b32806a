#include "robot_model/tables.h"

namespace robot_model {

namespace {

// Sony's tables let the hind knees bend to 122 degrees, but Sony's own motions for the ERS-7 (sitting and sleeping, in
// MOTION7.ODA of the samples) bend them to 125. This leaves 2 degrees to the mechanical limit.
const Joint JOINTS[] = {
    {"neck_tilt", 1, "PRM:/r1/c1-Joint2:11", RANGE(-75, 0), RANGE(-80, 3), 3185226, GAINS(0x0A, 0x04, 0x02)},
    {"head_pan", 2, "PRM:/r1/c1/c2-Joint2:12", RANGE(-88, 88), RANGE(-93, 93), 10057460, GAINS(0x08, 0x02, 0x04)},
    {"head_tilt", 3, "PRM:/r1/c1/c2/c3-Joint2:13", RANGE(-15, 45), RANGE(-20, 50), 5781403, GAINS(0x08, 0x04, 0x02)},
    {"mouth", 4, "PRM:/r1/c1/c2/c3/c4-Joint2:14", RANGE(-55, -3), RANGE(-60, 0), 10144726, GAINS(0x08, 0x00, 0x04)},
    {"left_front_rotator", 11, "PRM:/r2/c1-Joint2:21", RANGE(-115, 130), RANGE(-120, 135), 4865105,
     GAINS(0x1C, 0x08, 0x01)},
    {"left_front_elevator", 12, "PRM:/r2/c1/c2-Joint2:22", RANGE(-10, 88), RANGE(-15, 93), 5279621,
     GAINS(0x14, 0x04, 0x01)},
    {"left_front_knee", 13, "PRM:/r2/c1/c2/c3-Joint2:23", RANGE(-25, 122), RANGE(-30, 127), 5279621,
     GAINS(0x1C, 0x08, 0x01)},
    {"left_hind_rotator", 21, "PRM:/r3/c1-Joint2:31", RANGE(-130, 115), RANGE(-135, 120), 4865105,
     GAINS(0x1C, 0x08, 0x01)},
    {"left_hind_elevator", 22, "PRM:/r3/c1/c2-Joint2:32", RANGE(-10, 88), RANGE(-15, 93), 5279621,
     GAINS(0x14, 0x04, 0x01)},
    {"left_hind_knee", 23, "PRM:/r3/c1/c2/c3-Joint2:33", RANGE(-25, 125), RANGE(-30, 127), 5279621,
     GAINS(0x1C, 0x08, 0x01)},
    {"right_front_rotator", 31, "PRM:/r4/c1-Joint2:41", RANGE(-115, 130), RANGE(-120, 135), 4865105,
     GAINS(0x1C, 0x08, 0x01)},
    {"right_front_elevator", 32, "PRM:/r4/c1/c2-Joint2:42", RANGE(-10, 88), RANGE(-15, 93), 5279621,
     GAINS(0x14, 0x04, 0x01)},
    {"right_front_knee", 33, "PRM:/r4/c1/c2/c3-Joint2:43", RANGE(-25, 122), RANGE(-30, 127), 5279621,
     GAINS(0x1C, 0x08, 0x01)},
    {"right_hind_rotator", 41, "PRM:/r5/c1-Joint2:51", RANGE(-130, 115), RANGE(-135, 120), 4865105,
     GAINS(0x1C, 0x08, 0x01)},
    {"right_hind_elevator", 42, "PRM:/r5/c1/c2-Joint2:52", RANGE(-10, 88), RANGE(-15, 93), 5279621,
     GAINS(0x14, 0x04, 0x01)},
    {"right_hind_knee", 43, "PRM:/r5/c1/c2/c3-Joint2:53", RANGE(-25, 125), RANGE(-30, 127), 5279621,
     GAINS(0x1C, 0x08, 0x01)},
    {"tail_pan", 51, "PRM:/r6/c2-Joint2:62", RANGE(-45, 45), RANGE(-60, 60), 15162548, GAINS(0x0A, 0x04, 0x04)},
    {"tail_tilt", 52, "PRM:/r6/c1-Joint2:61", RANGE(5, 60), RANGE(0, 65), 15162548, GAINS(0x0A, 0x04, 0x04)},
};

// The coupled limits of rotator and elevator are from section 2.1.2.
const CouplingRow FRONT_LEG[] = {
    ROW(-115, -76, -1), ROW(-75, -54, -2), ROW(-55, -46, -3), ROW(-45, -36, -4), ROW(-35, -31, -5), ROW(-30, -26, -6),
    ROW(-25, -21, -7),  ROW(-20, -16, -8), ROW(-15, -11, -9), ROW(-10, 20, -10), ROW(21, 25, -9),   ROW(26, 30, -8),
    ROW(29, 40, -7),    ROW(41, 45, -6),   ROW(46, 50, -5),   ROW(51, 55, -4),   ROW(56, 65, -3),   ROW(64, 130, -2),
};

const CouplingRow HIND_LEG[] = {
    ROW(-130, -71, 0), ROW(-70, -56, -1), ROW(-55, -46, -2), ROW(-45, -41, -3), ROW(-40, -36, -4), ROW(-35, -31, -5),
    ROW(-30, -26, -6), ROW(-25, -21, -7), ROW(-20, -16, -8), ROW(-15, -11, -9), ROW(-10, 15, -10), ROW(16, 20, -9),
    ROW(21, 25, -8),   ROW(26, 30, -7),   ROW(31, 35, -6),   ROW(36, 40, -5),   ROW(41, 45, -4),   ROW(46, 50, -3),
    ROW(51, 60, -2),   ROW(61, 70, -1),   ROW(71, 115, 0),
};

// Neck and head while the mouth is open no further than -30 degrees. The next table covers a mouth that is open
// further.
const CouplingRow NECK[] = {
    ROW(-75, -39, 5),
    ROW(-40, 0, -5),
};

// Mouth and head. Sony gives no limits for a mouth that is open further than -30 degrees. An open jaw comes closer to
// the neck, so the head keeps to Sony's highest limit.
const CouplingRow MOUTH[] = {
    ROW(-55, -31, 5),
    ROW(-30, -3, -5),
};

#define COUPLING(leader, follower, rows) \
  { leader, follower, rows, NUMBER_OF(rows) }

// Leaders and followers are indices into JOINTS.
const Coupling COUPLINGS[] = {
    COUPLING(4, 5, FRONT_LEG),  COUPLING(7, 8, HIND_LEG), COUPLING(10, 11, FRONT_LEG),
    COUPLING(13, 14, HIND_LEG), COUPLING(0, 2, NECK),     COUPLING(3, 2, MOUTH),
};

const Sensor SENSORS[] = {
    TOUCH("head_touch", 5, "PRM:/r1/c1/c2/c3/t1-Sensor:t1", 9, 9),
    TOUCH("back_rear", 6, "PRM:/t2-Sensor:t2", 14, 10),
    TOUCH("back_middle", 7, "PRM:/t3-Sensor:t3", 14, 10),
    TOUCH("back_front", 8, "PRM:/t4-Sensor:t4", 12, 12),
    SWITCH("chin", 9, "PRM:/r1/c1/c2/c3/c4/s5-Sensor:s5"),
    SWITCH("paw_left_front", 14, "PRM:/r2/c1/c2/c3/c4-Sensor:24"),
    SWITCH("paw_left_hind", 24, "PRM:/r3/c1/c2/c3/c4-Sensor:34"),
    SWITCH("paw_right_front", 34, "PRM:/r4/c1/c2/c3/c4-Sensor:44"),
    SWITCH("paw_right_hind", 44, "PRM:/r5/c1/c2/c3/c4-Sensor:54"),
    DISTANCE("range_near", 53, "PRM:/r1/c1/c2/c3/p1-Sensor:p1", 50, 500),
    DISTANCE("range_far", 54, "PRM:/r1/c1/c2/c3/p2-Sensor:p2", 200, 1500),
    DISTANCE("range_chest", 55, "PRM:/p1-Sensor:p1", 100, 900),
    ACCELERATION("acceleration_front_back", 61, "PRM:/a1-Sensor:a1"),
    ACCELERATION("acceleration_right_left", 62, "PRM:/a2-Sensor:a2"),
    ACCELERATION("acceleration_up_down", 63, "PRM:/a3-Sensor:a3"),
    CHARGE("battery", 66),
    TEMPERATURE("temperature", 67, 0),
    SWITCH("wlan_switch", 94, "PRM:/b1-Sensor:b1"),
};

const Led LEDS[] = {
    {"head_color", 1, "PRM:/r1/c1/c2/c3/l1-LED2:l1", LED2, LED_ON_HEAD},
    {"head_white", 2, "PRM:/r1/c1/c2/c3/l2-LED2:l2", LED2, LED_ON_HEAD},
    {"mode_red", 3, "PRM:/r1/c1/c2/c3/l3-LED2:l3", LED2, LED_ON_HEAD},
    {"mode_green", 4, "PRM:/r1/c1/c2/c3/l4-LED2:l4", LED2, LED_ON_HEAD},
    {"mode_blue", 5, "PRM:/r1/c1/c2/c3/l5-LED2:l5", LED2, LED_ON_HEAD},
    {"wireless", 6, "PRM:/r1/c1/c2/c3/l6-LED2:l6", LED2, LED_ON_HEAD},
    {"face_1", 7, "PRM:/r1/c1/c2/c3/la-LED3:la", LED3, LED_ON_FACE},
    {"face_2", 8, "PRM:/r1/c1/c2/c3/lb-LED3:lb", LED3, LED_ON_FACE},
    {"face_3", 9, "PRM:/r1/c1/c2/c3/lc-LED3:lc", LED3, LED_ON_FACE},
    {"face_4", 10, "PRM:/r1/c1/c2/c3/ld-LED3:ld", LED3, LED_ON_FACE},
    {"face_5", 11, "PRM:/r1/c1/c2/c3/le-LED3:le", LED3, LED_ON_FACE},
    {"face_6", 12, "PRM:/r1/c1/c2/c3/lf-LED3:lf", LED3, LED_ON_FACE},
    {"face_7", 13, "PRM:/r1/c1/c2/c3/lg-LED3:lg", LED3, LED_ON_FACE},
    {"face_8", 14, "PRM:/r1/c1/c2/c3/lh-LED3:lh", LED3, LED_ON_FACE},
    {"face_9", 15, "PRM:/r1/c1/c2/c3/li-LED3:li", LED3, LED_ON_FACE},
    {"face_10", 16, "PRM:/r1/c1/c2/c3/lj-LED3:lj", LED3, LED_ON_FACE},
    {"face_11", 17, "PRM:/r1/c1/c2/c3/lk-LED3:lk", LED3, LED_ON_FACE},
    {"face_12", 18, "PRM:/r1/c1/c2/c3/ll-LED3:ll", LED3, LED_ON_FACE},
    {"face_13", 19, "PRM:/r1/c1/c2/c3/lm-LED3:lm", LED3, LED_ON_FACE},
    {"face_14", 20, "PRM:/r1/c1/c2/c3/ln-LED3:ln", LED3, LED_ON_FACE},
    {"back_front_color", 21, "PRM:/lu-LED3:lu", LED3, LED_ON_BACK},
    {"back_front_white", 22, "PRM:/lv-LED3:lv", LED3, LED_ON_BACK},
    {"back_middle_color", 23, "PRM:/lw-LED3:lw", LED3, LED_ON_BACK},
    {"back_middle_white", 24, "PRM:/lx-LED3:lx", LED3, LED_ON_BACK},
    {"back_rear_color", 25, "PRM:/ly-LED3:ly", LED3, LED_ON_BACK},
    {"back_rear_white", 26, "PRM:/lz-LED3:lz", LED3, LED_ON_BACK},
};

const Ear EARS[] = {
    {"left_ear", 1, "PRM:/r1/c1/c2/c3/e5-Joint4:15", EAR_JOINT4},
    {"right_ear", 2, "PRM:/r1/c1/c2/c3/e6-Joint4:16", EAR_JOINT4},
};

}  // namespace

// Channel 7 of the colour detection cannot be used: Model Information ERS-7, section 3.2.1.
const RobotModel ERS7 = {
    "ERS-7",         JOINTS, NUMBER_OF(JOINTS), COUPLINGS, NUMBER_OF(COUPLINGS), SENSORS, NUMBER_OF(SENSORS), LEDS,
    NUMBER_OF(LEDS), EARS,   NUMBER_OF(EARS),   7};

}  // namespace robot_model
