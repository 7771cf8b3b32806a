#include "rcserver/joints/JointOrders.h"

#include <stdio.h>
#include <stdlib.h>

using namespace protocol::version2;

namespace {

const EndReason DONE = {END_DONE, "", ""};

}  // namespace

const unsigned JointOrders::FRAMES_TO_FOLLOW;

JointOrders::JointOrders(const JointPlanner& planner, const robot_model::RobotModel& robot, OrderBook& book)
    : planner_(planner), robot_(robot), book_(book) {
  const OrderedJoint none = {OrderBook::NO_ORDER, 0, false, 0};
  for (int i = 0; i < robot_model::MAX_JOINTS; ++i) {
    joints_[i] = none;
  }
}

void JointOrders::Begin(const int* joints, int count, unsigned short number) {
  const int order = book_.Begin(ENDED_JOINTS, number, "");
  for (int i = 0; i < count; ++i) {
    const OrderedJoint joint = {order, planner_.Target(joints[i]), false, 0};
    joints_[joints[i]] = joint;
  }
  if (count == 0) {
    book_.End(order, DONE);
  }
}

void JointOrders::Leave(int joint, const EndReason& reason) {
  const int order = joints_[joint].order;
  if (order == OrderBook::NO_ORDER) {
    return;
  }
  joints_[joint].order = OrderBook::NO_ORDER;
  if (reason.how == END_REFUSED) {
    book_.Spoil(order, reason);
  }
  if (!HasJoint(order)) {
    book_.End(order, reason);
  }
}

void JointOrders::Measured(const int* positions, unsigned frame) {
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    if (joints_[i].order != OrderBook::NO_ORDER) {
      Judge(i, abs(positions[i] - joints_[i].target), frame);
    }
  }
}

bool JointOrders::HasJoint(int order) const {
  for (int i = 0; i < robot_model::MAX_JOINTS; ++i) {
    if (joints_[i].order == order) {
      return true;
    }
  }
  return false;
}

// Checks whether the joint has arrived. New limits or a coupling can delay a joint that was there already.
void JointOrders::Judge(int joint, int distance, unsigned frame) {
  OrderedJoint& ordered = joints_[joint];
  const bool was_over = ordered.is_over;
  ordered.is_over = planner_.FramesLeft(joint) == 0;
  ordered.since = was_over ? ordered.since : frame;
  if (!ordered.is_over || frame - ordered.since < FRAMES_TO_FOLLOW) {
    return;
  }
  if (distance <= ARRIVED) {
    Leave(joint, DONE);
  } else if (frame - ordered.since >= FRAMES_TO_FOLLOW + ARRIVAL_FRAMES) {
    char words[OrderBook::MAX_TEXT_SIZE];
    sprintf(words, "%s stays %d.%03d rad from its target", robot_.joints[joint].name, distance / 1000000,
            distance / 1000 % 1000);
    Leave(joint, EndReason::Of(END_REFUSED, "%s", words));
  }
}
