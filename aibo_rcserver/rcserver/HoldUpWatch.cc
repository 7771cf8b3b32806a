#include "rcserver/HoldUpWatch.h"

const unsigned HoldUpWatch::LONGEST_PAUSE;
const unsigned HoldUpWatch::LONGEST_SILENCE;
const unsigned HoldUpWatch::CATCHING_UP;

const char HoldUpWatch::TOO_OLD[] = "too old: the robot's program or the link was held up; send it again";
