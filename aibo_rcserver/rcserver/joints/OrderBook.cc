#include "rcserver/joints/OrderBook.h"

#include <stdio.h>
#include <string.h>

const int OrderBook::NO_ORDER;
const int OrderBook::MAX_MOTIONS;
const int OrderBook::MAX_LIVE;
const unsigned OrderBook::MAX_ENDS;
const int OrderBook::MAX_TEXT_SIZE;

namespace {

const EndReason NEW_CLIENT = {protocol::version2::END_STOPPED, "the connection is new", ""};

}  // namespace

void EndReason::Describe(char* text) const {
  sprintf(text, format, joint);
}

OrderBook::OrderBook() {
  for (int i = 0; i < MAX_LIVE; ++i) {
    live_[i].is_used = false;
  }
  ClientGone();
}

int OrderBook::Begin(unsigned char what, unsigned short number, const char* name) {
  int order = 0;
  while (live_[order].is_used) {
    ++order;
  }
  LiveOrder& live = live_[order];
  live.is_used = true;
  live.is_spoilt = false;
  live.end.what = what;
  live.end.number = number;
  strcpy(live.end.name, name);
  return order;
}

void OrderBook::Spoil(int order, const EndReason& reason) {
  LiveOrder& live = live_[order];
  if (!live.is_spoilt) {
    live.is_spoilt = true;
    live.end.how = reason.how;
    reason.Describe(live.end.reason);
  }
}

void OrderBook::End(int order, const EndReason& reason) {
  if (order == NO_ORDER) {
    return;
  }
  Spoil(order, reason);
  const OrderEnd& end = live_[order].end;
  live_[order].is_used = false;
  if (end.number != 0 || end.what == protocol::version2::ENDED_POSTURE) {
    ends_.Add(end);
  }
}

void OrderBook::ClientGone() {
  for (int i = 0; i < MAX_LIVE; ++i) {
    live_[i].end.number = 0;
  }
  ends_.Clear();
  DemandLettingGo(NEW_CLIENT);
}

void OrderBook::DemandLettingGo(const EndReason& why) {
  why.Describe(why_);
}
