#include "robot_model/tables.h"

namespace robot_model {

namespace {

const Joint JOINTS[] = {
    {"head_tilt", 1, "PRM:/r1/c1-Joint2:j1", RANGE(-82, 43), RANGE(-85, 46), 2105000, GAINS(0x0A, 0x08, 0x0C)},
    {"head_pan", 2, "PRM:/r1/c1/c2-Joint2:j2", RANGE(-89.6, 89.6), RANGE(-92.6, 92.6), 3011000,
     GAINS(0x0D, 0x08, 0x0B)},
    {"head_roll", 3, "PRM:/r1/c1/c2/c3-Joint2:j3", RANGE(-29, 29), RANGE(-32, 32), 3011000, GAINS(0x0A, 0x08, 0x0C)},
    {"mouth", 4, "PRM:/r1/c1/c2/c3/c4-Joint2:j4", RANGE(-47, -3), RANGE(-50, 0), 4374000, GAINS(0x0E, 0x08, 0x10)},
    {"left_front_rotator", 11, "PRM:/r2/c1-Joint2:j1", RANGE(-117, 117), RANGE(-120, 120), 2814000,
     GAINS(0x16, 0x04, 0x08)},
    {"left_front_elevator", 12, "PRM:/r2/c1/c2-Joint2:j2", RANGE(-11, 89), RANGE(-14, 92), 2498000,
     GAINS(0x14, 0x04, 0x06)},
    {"left_front_knee", 13, "PRM:/r2/c1/c2/c3-Joint2:j3", RANGE(-27, 147), RANGE(-30, 150), 2836000,
     GAINS(0x23, 0x04, 0x05)},
    {"left_hind_rotator", 21, "PRM:/r3/c1-Joint2:j1", RANGE(-117, 117), RANGE(-120, 120), 2814000,
     GAINS(0x16, 0x04, 0x08)},
    {"left_hind_elevator", 22, "PRM:/r3/c1/c2-Joint2:j2", RANGE(-11, 89), RANGE(-14, 92), 2498000,
     GAINS(0x14, 0x04, 0x06)},
    {"left_hind_knee", 23, "PRM:/r3/c1/c2/c3-Joint2:j3", RANGE(-27, 147), RANGE(-30, 150), 2836000,
     GAINS(0x23, 0x04, 0x05)},
    {"right_front_rotator", 31, "PRM:/r4/c1-Joint2:j1", RANGE(-117, 117), RANGE(-120, 120), 2814000,
     GAINS(0x16, 0x04, 0x08)},
    {"right_front_elevator", 32, "PRM:/r4/c1/c2-Joint2:j2", RANGE(-11, 89), RANGE(-14, 92), 2498000,
     GAINS(0x14, 0x04, 0x06)},
    {"right_front_knee", 33, "PRM:/r4/c1/c2/c3-Joint2:j3", RANGE(-27, 147), RANGE(-30, 150), 2836000,
     GAINS(0x23, 0x04, 0x05)},
    {"right_hind_rotator", 41, "PRM:/r5/c1-Joint2:j1", RANGE(-117, 117), RANGE(-120, 120), 2814000,
     GAINS(0x16, 0x04, 0x08)},
    {"right_hind_elevator", 42, "PRM:/r5/c1/c2-Joint2:j2", RANGE(-11, 89), RANGE(-14, 92), 2498000,
     GAINS(0x14, 0x04, 0x06)},
    {"right_hind_knee", 43, "PRM:/r5/c1/c2/c3-Joint2:j3", RANGE(-27, 147), RANGE(-30, 150), 2836000,
     GAINS(0x23, 0x04, 0x05)},
    {"tail_pan", 51, "PRM:/r6/c1-Joint2:j1", RANGE(-22, 22), RANGE(-25, 25), 4472000, GAINS(0x0A, 0x00, 0x18)},
    {"tail_tilt", 52, "PRM:/r6/c2-Joint2:j2", RANGE(-22, 22), RANGE(-25, 25), 4472000, GAINS(0x07, 0x00, 0x11)},
};

const Sensor SENSORS[] = {
    FORCE("head_rear", 5, "PRM:/r1/c1/c2/c3/f1-Sensor:f1"),
    FORCE("head_front", 6, "PRM:/r1/c1/c2/c3/f2-Sensor:f2"),
    SWITCH("chin", 7, "PRM:/r1/c1/c2/c3/c4/s5-Sensor:s5"),
    DISTANCE("range_head", 8, "PRM:/r1/c1/c2/c3/p1-Sensor:p1", 100, 900),
    SWITCH("paw_left_front", 14, "PRM:/r2/c1/c2/c3/c4-Sensor:s4"),
    SWITCH("paw_left_hind", 24, "PRM:/r3/c1/c2/c3/c4-Sensor:s4"),
    SWITCH("paw_right_front", 34, "PRM:/r4/c1/c2/c3/c4-Sensor:s4"),
    SWITCH("paw_right_hind", 44, "PRM:/r5/c1/c2/c3/c4-Sensor:s4"),
    TEMPERATURE("temperature", 53, "PRM:/r6/t1-Sensor:t1"),
    SWITCH("back", 54, "PRM:/r6/s1-Sensor:s1"),
    ACCELERATION("acceleration_front_back", 61, "PRM:/a1-Sensor:a1"),
    ACCELERATION("acceleration_right_left", 62, "PRM:/a2-Sensor:a2"),
    ACCELERATION("acceleration_up_down", 63, "PRM:/a3-Sensor:a3"),
};

const Led LEDS[] = {
    {"eye_left_bottom", 1, "PRM:/r1/c1/c2/c3/l1-LED2:l1", LED2, LED_ON_FACE},
    {"eye_left_middle", 2, "PRM:/r1/c1/c2/c3/l2-LED2:l2", LED2, LED_ON_FACE},
    {"eye_left_top", 3, "PRM:/r1/c1/c2/c3/l3-LED2:l3", LED2, LED_ON_FACE},
    {"eye_right_bottom", 4, "PRM:/r1/c1/c2/c3/l4-LED2:l4", LED2, LED_ON_FACE},
    {"eye_right_middle", 5, "PRM:/r1/c1/c2/c3/l5-LED2:l5", LED2, LED_ON_FACE},
    {"eye_right_top", 6, "PRM:/r1/c1/c2/c3/l6-LED2:l6", LED2, LED_ON_FACE},
    {"mode", 7, "PRM:/r1/c1/c2/c3/l7-LED2:l7", LED2, LED_ON_HEAD},
    {"tail_blue", 8, "PRM:/r6/l1-LED2:l1", LED2, LED_ON_TAIL},
    {"tail_orange", 9, "PRM:/r6/l2-LED2:l2", LED2, LED_ON_TAIL},
};

const Ear EARS[] = {
    {"left_ear", 1, "PRM:/r1/c1/c2/c3/e1-Joint3:j5", EAR_JOINT3},
    {"right_ear", 2, "PRM:/r1/c1/c2/c3/e2-Joint3:j6", EAR_JOINT3},
};

}  // namespace

// There are no coupled limits in Sony's Model Information ERS-210.
const RobotModel ERS210 = {"ERS-210",       JOINTS, NUMBER_OF(JOINTS), 0, 0, SENSORS, NUMBER_OF(SENSORS), LEDS,
                           NUMBER_OF(LEDS), EARS,   NUMBER_OF(EARS),   8};

}  // namespace robot_model
