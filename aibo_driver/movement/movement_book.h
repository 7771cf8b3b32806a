/// @file movement_book.h
#ifndef AIBO_DRIVER_MOVEMENT_MOVEMENT_BOOK_H
#define AIBO_DRIVER_MOVEMENT_MOVEMENT_BOOK_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <future>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "aibo_client/orders.h"
#include "movement/joint_plan.h"
#include "movement/movement.h"

namespace aibo_driver::movement {

/// Knows the movements that have not ended, and how the latest have ended.
///
/// A movement sends one or more orders to the robot, each with a number of its own. The book keeps the set of those
/// that the robot has not ended yet. The movement ends when this set is empty, with the end that emptied it. So no
/// end is ever guessed. Only a trajectory may have more to send when its set is empty, and only its tolerances are
/// judged here.
///
/// Only one thread at a time may use a book.
class MovementBook {
 public:
  using OrderNumber = std::uint64_t;

  /// How many ended movements are remembered.
  static constexpr std::size_t kEndsRemembered = 64;

  /// How a movement that was halted is reported as ended, unless something else ended it first.
  struct Halt {
    aibo_client::EndedHow how = aibo_client::EndedHow::kStopped;
    std::string reason;  ///< empty if nobody has to be told
  };

  /// A movement that has not ended.
  struct Record {
    Movement movement;
    std::promise<EndedMovement> promise;
    std::shared_future<EndedMovement> end;
    std::set<OrderNumber> orders;       ///< the orders that were sent and have not ended
    std::optional<Halt> halt;           ///< set if the movement sends nothing more, and ends when its orders have ended
    std::string trouble;                ///< what went wrong with an order while others went on
    std::optional<SteadyTime> steered;  ///< for a walk to a goal: when it was last steered

    MovementId id() const { return movement.order; }
    bool is(Movement::Kind kind) const { return movement.kind == kind; }

    /// True if the movement was halted for a reason that somebody has to be told.
    bool hasReasonToEnd() const { return halt && !halt->reason.empty(); }
  };

  /// @param plan plans the trajectories, and must outlive the book
  explicit MovementBook(JointPlan& plan) : plan_(plan) {}

  /// A number that no movement and no order has had.
  OrderNumber nextNumber() { return ++last_number_; }

  /// @param movement the movement, which gets a number unless it has one
  /// @param order the number of the movement's first order, if that was sent
  Record& begin(Movement movement, std::optional<OrderNumber> order = std::nullopt);

  /// Notes a movement that is refused. If commands and walks of one node are refused again and again for the same
  /// reason, with less than half a second between them, only the first is noted.
  EndedMovement refuse(Movement movement, const std::string& reason, SteadyTime now);

  /// Makes a movement send nothing more. It ends now if the robot has ended all of its orders.
  void halt(Record* record, const Halt& halt);

  /// Halts all movements that fulfil a condition and have not been halted.
  template <typename Condition>
  void haltEach(const Condition& condition, const Halt& halt) {
    for (const MovementId id : idsOf([&](const Record& each) { return !each.halt && condition(each); })) {
      this->halt(find(id), halt);
    }
  }

  /// Notes that the robot has ended an order. The movement goes on if it has other orders, or if a trajectory has more
  /// to send or to measure. Otherwise it ends:
  /// - with the reason why it was halted, if its order was stopped, or if it had more to do and has not failed
  /// - stopped, if it is a walk to a goal that nobody has halted, because the robot was not steered
  /// - or as the robot says
  void endOrder(Record* record, OrderNumber order, aibo_client::EndedHow how, std::string reason);

  /// Ends a movement. It does nothing if the movement has ended.
  void close(MovementId id, aibo_client::EndedHow how, const std::string& reason);

  /// Ends all movements.
  void closeAll(aibo_client::EndedHow how, const std::string& reason);

  /// Ends the trajectories that the plan has ended.
  void takeEndsOfPlan();

  template <typename Condition>
  std::vector<MovementId> idsOf(const Condition& condition) const {
    std::vector<MovementId> ids;
    for (const Record& record : records_) {
      if (condition(record)) {
        ids.push_back(record.id());
      }
    }
    return ids;
  }

  /// @return null if no movement fulfils the condition
  template <typename Condition>
  Record* findIf(const Condition& condition) {
    const auto found = std::find_if(records_.begin(), records_.end(), condition);
    return found == records_.end() ? nullptr : &*found;
  }

  /// @return null if the movement has ended
  Record* find(MovementId id);

  /// @return null if no movement waits for the end of this order
  Record* ownerOf(OrderNumber order);

  /// The walk that can be steered; null if there is none.
  Record* findWalk();

  /// The movement that goes on if a node commands the same joints again; null if there is none.
  Record* findCommand(const Movement& movement);

  /// The movements that go on, with the joints that they still move, and with their ends.
  std::vector<Movement> movements() const;

  /// The latest ends; the newest is last.
  std::vector<EndedMovement> ended() const { return {ended_.begin(), ended_.end()}; }

  /// How many movements have ended so far.
  std::size_t ends() const { return ends_; }

  /// The movements that have ended since the last call, in order.
  std::vector<EndedMovement> takeNews() { return std::exchange(news_, {}); }

 private:
  Movement whole(const Record& record) const;
  bool isRepeated(const EndedMovement& refused, SteadyTime now);
  void note(const EndedMovement& ended);

  JointPlan& plan_;
  std::list<Record> records_;
  OrderNumber last_number_ = 0;  ///< the number of the last movement or order
  std::deque<EndedMovement> ended_;
  std::size_t ends_ = 0;
  std::vector<EndedMovement> news_;
  /// When an order was last refused: by its kind, node and joints, and the reason.
  std::map<std::tuple<Movement::Kind, std::string, std::vector<std::string>, std::string>, SteadyTime> refused_;
};

}  // namespace aibo_driver::movement

#endif  // AIBO_DRIVER_MOVEMENT_MOVEMENT_BOOK_H
