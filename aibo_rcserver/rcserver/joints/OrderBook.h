#ifndef AIBO_RCSERVER_RCSERVER_JOINTS_ORDER_BOOK_H
#define AIBO_RCSERVER_RCSERVER_JOINTS_ORDER_BOOK_H

#include <stddef.h>

#include "protocol/text.h"
#include "protocol/version2.h"
#include "rcserver/Queue.h"
#include "robot_model/robot_model.h"

/// Why an order ends. This is a plain structure, so that constants need no constructor at start-up.
struct EndReason {
  unsigned char how;   ///< END_DONE and so on
  const char* format;  ///< text for the user, with %s for the joint; a literal
  const char* joint;   ///< the joint's name in the robot's table, or ""

  static EndReason Of(unsigned char how, const char* format, const char* joint = "") {
    const EndReason reason = {how, format, joint};
    return reason;
  }

  /// @param[out] text room for OrderBook::MAX_TEXT_SIZE bytes
  void Describe(char* text) const;
};

/// Knows the orders that go on. Each order ends once, and its end is kept until it has been reported to the client.
///
/// The book also says whether a client has to let go before the robot walks. Without this, a client that keeps steering
/// would at once restart a walk that something else has ended.
class OrderBook {
 public:
  /// The value that means no order.
  static const int NO_ORDER = -1;

  /// The most motions at once: head, tail, mouth and legs.
  static const int MAX_MOTIONS = 4;

  /// The most orders at a time: each joint in a command of its own, the motions, and a walk or a posture.
  static const int MAX_LIVE = robot_model::MAX_JOINTS + MAX_MOTIONS + 1;

  /// Ends that can wait for a client: those of all orders that live, and of one that ends as soon as it begins. A
  /// request must be carried out only if no end waits. Without a client of version 2, the oldest end is forgotten.
  static const unsigned MAX_ENDS = MAX_LIVE + 1;

  static const int MAX_TEXT_SIZE = 160;

  struct OrderEnd {
    unsigned char what;     ///< ENDED_MOTION, ENDED_WALK, ENDED_POSTURE or ENDED_JOINTS
    unsigned char how;      ///< END_DONE and so on
    unsigned short number;  ///< number of the request; 0 if it is not the present client's
    protocol::FileName name;
    char reason[MAX_TEXT_SIZE];  ///< such as "left_front_knee was commanded"; empty for END_DONE
  };

  OrderBook();

  /// Begins an order.
  /// @param what see OrderEnd::what
  /// @param number number of the request; 0 for orders without one
  /// @param name the motion's name, WALK_NAME, or postureName(); empty for joints
  /// @return the order, valid until End()
  int Begin(unsigned char what, unsigned short number, const char* name);

  /// Call this when something has gone wrong with an order that goes on: whenever it ends, it ends for this reason.
  /// Only the first reason counts.
  void Spoil(int order, const EndReason& reason);

  /// Ends an order. NO_ORDER is ignored. Of orders without a number, only the end of a posture is reported, which is a
  /// rest that an earlier client has begun. A motion without a number was begun in version 1, which reports no ends.
  void End(int order, const EndReason& reason);

  /// The number of the order's request; 0 if it has none, or for NO_ORDER.
  unsigned short Number(int order) const { return order == NO_ORDER ? 0 : live_[order].end.number; }

  /// Returns each end to be reported to the client once, the oldest first.
  /// @return false if there is none
  bool Take(OrderEnd* end) { return ends_.Take(end); }

  /// Forgets the ends that the client has not taken. The orders that go on do not belong to the next client, which must
  /// let go before the robot walks.
  void ClientGone();

  void DemandLettingGo(const EndReason& why);
  void LetGo() { why_[0] = '\0'; }

  /// Why the client must let go before the robot walks; NULL if it need not.
  const char* WhyToLetGo() const { return why_[0] != '\0' ? why_ : NULL; }

 private:
  // An order that is being carried out.
  struct LiveOrder {
    bool is_used;
    bool is_spoilt;  ///< end.how and end.reason are set
    OrderEnd end;
  };

  LiveOrder live_[MAX_LIVE];
  Queue<OrderEnd, MAX_ENDS> ends_;
  char why_[MAX_TEXT_SIZE];  ///< why the client must let go; empty if it need not
};

#endif  // AIBO_RCSERVER_RCSERVER_JOINTS_ORDER_BOOK_H
