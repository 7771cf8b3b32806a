#include "client/session.h"

#include <algorithm>
#include <utility>

#include "aibo_driver/exceptions.h"
#include "aibo_driver/jpeg_inspector.h"
#include "client/fault.h"

namespace aibo_driver {
namespace {

// However impatient the user is with pictures: an answer may have to wait behind one.
constexpr std::chrono::milliseconds kShortestAnswerLimit{1000};
// What a weak wireless link of 1 Mbit/s leaves beside a stream, and a memory stick takes.
constexpr std::size_t kSlowestTransfer = 32 * 1024;  // bytes/s

// Commands to the joints are for now. Whoever gave one has seen by then that nothing moves.
constexpr std::chrono::milliseconds kLongestJointWait{500};

}  // namespace

Session::Session(const SessionContext& context, TimePoint connected)
    : context_(context),
      stream_(connected),
      stall_detector_(connected),
      last_picture_sign_(connected),
      transfer_end_(connected),
      joints_turn_(connected) {}

void Session::bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now) {
  counters().bytes_received += size;
  now_ = now;
  if (stream_.on()) {
    stall_detector_.bytesArrived(now);
  }
  try {
    parse(data, size);
  } catch (const ProtocolException& error) {
    throw Fault::protocol(address(), error.what());
  }
}

void Session::toggleStream(int quality, TimePoint now) {
  stream_.toggled(quality, now);
  stall_detector_.restart(now);
  signOfPicture(now);
}

Session::MutablePicturePtr Session::inspect(Bytes jpeg, TimePoint first_byte_time) {
  const JpegInspection inspection = inspectJpeg(jpeg.data(), jpeg.size());
  if (!inspection.good()) {
    ++counters().corrupt_pictures;
    if (inspection.problem != std::exchange(last_damage_, inspection.problem)) {
      notifier().log(LogLevel::kWarn,
                     address() + " sent a damaged picture, which is dropped: " + inspection.problem + ".");
    }
    return nullptr;
  }
  auto picture = std::make_shared<Picture>();
  picture->jpeg = std::move(jpeg);
  picture->first_byte_time = last_first_byte_ = std::max(first_byte_time, last_first_byte_ + TimePoint::duration(1));
  picture->width = inspection.width;
  picture->height = inspection.height;
  picture->connection_number = context_.connection_number;
  return picture;
}

void Session::dropUnexpected() {
  ++counters().unexpected_pictures;
  if (stream_.isOverdue(now_)) {
    throw Fault::protocol(address(), "it goes on sending pictures although it was told to stop, or never asked");
  }
}

void Session::publish(const PicturePtr& picture) {
  ++counters().pictures;
  notifier().picture(picture);
}

bool Session::publishFromStream(const PicturePtr& picture) {
  if (stall_detector_.isStale(picture->first_byte_time)) {
    ++counters().stale_pictures;
    return false;
  }
  publish(picture);
  return true;
}

std::string Session::damageRemark() const {
  return last_damage_.empty() ? "." : "; the last one was damaged: " + last_damage_ + ".";
}

void Session::transferBegins(std::size_t size, TimePoint now) {
  transfer_end_ = std::max(transfer_end_, now) + std::chrono::milliseconds(size * 1000 / kSlowestTransfer);
}

void Session::failSilent() const {
  throw Fault::silent(address(), context_.read_timeout);
}

std::chrono::milliseconds Session::answerLimit() const {
  return std::max(context_.read_timeout, kShortestAnswerLimit);
}

void Session::dropStaleJointCommands(TimePoint now) {
  const TimePoint stale = now - kLongestJointWait;
  if (std::exchange(joints_turn_, now) < stale && commands_.joints.dropOlderThan(stale)) {
    notifier().log(LogLevel::kWarn, "Joint commands that had to wait for " + address() + " for more than " +
                                        std::to_string(kLongestJointWait.count()) + " ms are dropped.");
  }
}

void Session::dropSupersededJointCommands(const RobotRequest& request) {
  if (takesOverJoints(request)) {
    commands_.joints = JointCommands();
  }
}

void Session::noteRefusal(char letter, const std::string& problem) {
  ++counters().refusals;
  if (problem != std::exchange(last_refusals_[letter], problem)) {
    notifier().log(LogLevel::kWarn, address() + " refused " + problem + ".");
  }
}

void Session::publishAccepted(const std::vector<JointTarget>& targets) {
  notifier().jointsAccepted(targets);
}

void Session::publish(Telemetry telemetry) {
  telemetry.connection_number = context_.connection_number;
  ++counters().telemetry;
  notifier().telemetry(telemetry);
}

}  // namespace aibo_driver
