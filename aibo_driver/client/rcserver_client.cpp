#include "aibo_client/rcserver_client.h"

#include <functional>
#include <future>
#include <memory>
#include <type_traits>
#include <utility>

#include "aibo_client/exceptions.h"
#include "aibo_client/jpeg_inspector.h"
#include "client/argument_checks.h"
#include "client/connection_loop.h"
#include "client/units.h"

namespace aibo_client {

namespace version2 = protocol::version2;

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Shared = ConnectionLoop::Shared;

namespace {

constexpr milliseconds kLongestTimeout{3600 * 1000};

/// If a call has failed, throws its exception.
void throwUnlessDone(const Answer& answer) {
  switch (answer.outcome) {
    case CallOutcome::kDone:
      break;
    case CallOutcome::kTimeout:
      throw TimeoutException(answer.problem, answer.fault, answer.was_sent);
    case CallOutcome::kRefused:
      throw CommandException(answer.problem);
    case CallOutcome::kConnectionLost:
      throw NetworkException(answer.problem, answer.fault, answer.was_sent);
    case CallOutcome::kStopped:
      throw StoppedException(answer.problem);
  }
}

/// @param words what the request is for
/// @throw CommandException this server does not know the request
void requireRequest(const ConnectionLoop& loop, const Shared& shared, const version2::Request& request,
                    const std::string& words, bool is_known_to_version1) {
  const ConnectionStatus& status = shared.status;
  if (status.protocol_version == 1 && !is_known_to_version1) {
    throw CommandException(loop.address() + " speaks version 1 of the protocol, which cannot " + words +
                           ". It needs an RCServer that speaks version 2.");
  }
  if (status.protocol_version > 1 && request.has(version2::MOVES_BODY) &&
      !status.robot.hasCapability(std::string(1, request.letter))) {
    throw CommandException(loop.address() + " (" + status.robot.server + ") cannot " + words +
                           ": its robot does not walk");
  }
}

/// Hands a call to the client's thread.
/// @param read makes the result of the call from its answer
/// @param complete called with the shared state and the call when the call can no longer be refused here
/// @return becomes ready with the result, or with the exception that says why the call has failed
/// @throw the exceptions of RcServerClient::beginMotors(). If it throws, it has handed over no call
template <typename Read, typename Result = std::invoke_result_t<Read, Answer>>
std::future<Result> begin(
    ConnectionLoop* loop, Call call, milliseconds timeout, const Read& read,
    const std::function<void(Shared*, Call*)>& complete = [](Shared*, Call*) {}) {
  checkRange("timeout", timeout.count(), 1, kLongestTimeout.count(), " ms");
  const auto promise = std::make_shared<std::promise<Result>>();
  call.timeout = timeout;
  call.deadline = steady_clock::now() + timeout;
  call.end = [promise, read](Answer answer) {
    try {
      throwUnlessDone(answer);
      if constexpr (std::is_void_v<Result>) {
        promise->set_value();
      } else {
        promise->set_value(read(std::move(answer)));
      }
    } catch (...) {
      promise->set_exception(std::current_exception());
    }
  };
  loop->change([&](Shared& shared) {
    loop->requireConnection(shared);
    requireRequest(*loop, shared, call.request, describe(call), isKnownToVersion1(call));
    complete(&shared, &call);
    call.dropFrom(&shared.commands);
    shared.calls.push_back(std::move(call));
  });
  return promise->get_future();
}

void readNothing(const Answer& /*answer*/) {}

/// Waits for what `begin` has begun.
/// @param caller the name of the function, for messages
template <typename Begin>
auto waitFor(const ConnectionLoop& loop, const std::string& caller, const Begin& begin) {
  loop.read([&caller](const Shared& shared) { ConnectionLoop::requireOtherThread(shared, caller); });
  return begin().get();
}

/// Hands a call to the client's thread, and waits for its answer.
/// @param caller the name of the function, for messages
/// @param complete as for begin()
Answer ask(
    ConnectionLoop* loop, Call call, milliseconds timeout, const std::string& caller,
    const std::function<void(Shared*, Call*)>& complete = [](Shared*, Call*) {}) {
  const auto read = [](Answer answer) { return answer; };
  return waitFor(*loop, caller, [&] { return begin(loop, std::move(call), timeout, read, complete); });
}

/// Hands a command to the client's thread.
/// @param add called with the outbox
template <typename Add>
void command(ConnectionLoop* loop, const Add& add) {
  loop->change([&](Shared& shared) {
    loop->requireConnection(shared);
    add(shared.commands);
  });
}

/// Finds the place of these samples in their sound, and updates the place of the next samples in `shared`.
SoundPart placeOf(std::size_t size, std::uint64_t sound, bool is_last, Shared* shared) {
  SoundPart& next = shared->sound;
  if (sound == 0) {
    next = {++shared->sounds, 0, 0, false};
  } else if (sound != next.sound || next.is_last) {
    throw CommandException("the sound has ended, or another one has begun");
  }
  const SoundPart part = {next.sound, next.position, static_cast<std::uint32_t>(size), is_last};
  next.position += part.size;
  next.is_last = is_last;
  return part;
}

version2::Posture toProtocol(Posture posture) {
  switch (posture) {
    case Posture::kStand:
      return version2::POSTURE_STAND;
    case Posture::kSit:
      return version2::POSTURE_SIT;
    case Posture::kRest:
      break;
  }
  return version2::POSTURE_REST;
}

}  // namespace

RcServerClient::RcServerClient(const ClientOptions& options, Callbacks callbacks)
    : RcServerClient(options, std::move(callbacks), std::make_unique<TcpTransport>()) {}

RcServerClient::RcServerClient(const ClientOptions& options, Callbacks callbacks,
                               std::unique_ptr<TcpTransport> transport)
    : motion_bits_(options.leave_out_missing_joints ? version2::LEAVE_OUT_MISSING_JOINTS : 0) {
  checkClientOptions(options);
  loop_ = std::make_unique<ConnectionLoop>(options, std::move(callbacks), std::move(transport));
  guardWalks(options.guard_walks);
}

RcServerClient::~RcServerClient() {
  stop();
}

void RcServerClient::start() {
  loop_->start();
}

void RcServerClient::waitForConnection(milliseconds timeout) {
  checkRange("timeout", timeout.count(), 1, kLongestTimeout.count(), " ms");
  loop_->waitForConnection(timeout);
}

void RcServerClient::stop() noexcept {
  loop_->stop();
}

void RcServerClient::setStreaming(bool on) {
  loop_->change([on](Shared& shared) { shared.wish.streaming = on; });
}

void RcServerClient::setJpegQuality(int quality) {
  checkRange("jpeg_quality", quality, 1, 100);
  loop_->change([quality](Shared& shared) { shared.wish.jpeg_quality = quality; });
}

int RcServerClient::jpegQuality() const {
  return loop_->read([](const Shared& shared) { return shared.wish.jpeg_quality; });
}

void RcServerClient::setStreamFormat(const StreamFormat& format) {
  checkRange("every n-th image", format.every_nth_image, 1, 65535);
  loop_->change([&format](Shared& shared) { shared.wish.format = format; });
}

StreamFormat RcServerClient::streamFormat() const {
  return loop_->read([](const Shared& shared) { return shared.wish.format; });
}

void RcServerClient::setCameraSettings(const CameraSettings& settings) {
  checkRange("white balance", settings.white_balance, 1, 3);
  checkRange("gain", settings.gain, 1, 3);
  checkRange("shutter speed", settings.shutter_speed, 1, 3);
  loop_->change([&settings](Shared& shared) { shared.wish.camera = settings; });
}

void RcServerClient::setPictureTransport(PictureTransport transport) {
  loop_->change([transport](Shared& shared) {
    shared.wish.transport_changes += shared.wish.transport != transport ? 1 : 0;
    shared.wish.transport = transport;
  });
}

void RcServerClient::setColorDetection(const ColorDetection& detection) {
  checkRange("every n-th image", detection.every_nth_image, 1, 65535);
  loop_->change([&detection](Shared& shared) { shared.wish.colors = detection; });
}

void RcServerClient::setColorTable(int channel, ColorTablePtr table) {
  checkRange("channel", channel, 0, kMostColorChannels - 1);
  if (table) {
    checkColorTable(*table);
  }
  loop_->change([channel, &table](Shared& shared) {
    shared.wish.color_tables.at(static_cast<std::size_t>(channel)) = std::move(table);
  });
}

void RcServerClient::setMicrophone(const MicrophoneSettings& settings) {
  checkRange("channels", settings.channels, 1, 2);
  if (settings.samples_per_second != 8000 && settings.samples_per_second != 16000) {
    throw InvalidArgumentException("samples per second is " + std::to_string(settings.samples_per_second) +
                                   "; it must be 8000 or 16000");
  }
  loop_->change([&settings](Shared& shared) { shared.wish.microphone = settings; });
}

bool RcServerClient::streaming() const {
  return loop_->read([](const Shared& shared) { return shared.streaming; });
}

PicturePtr RcServerClient::takePicture(int quality, milliseconds timeout, int* stream_quality,
                                       std::optional<Resolution> resolution) {
  checkRange("quality", quality, 0, 100);
  const Answer answer = ask(loop_.get(), callForPicture(quality, resolution), timeout, "takePicture()");
  if (stream_quality != nullptr) {
    *stream_quality = answer.stream_quality;
  }
  return answer.picture;
}

void RcServerClient::commandJoints(const std::vector<JointTarget>& targets, milliseconds duration,
                                   const OrderTerms& terms) {
  checkJointTargets(targets, duration);
  std::vector<JointSpeedLimit> limits;
  for (const JointTarget& target : targets) {
    if (target.speed > 0) {
      limits.push_back({target.id, target.speed});
    }
  }
  command(loop_.get(), [&](CommandOutbox& outbox) {
    outbox.speed_limits.add(limits);
    outbox.command({duration, targets, terms});
  });
}

void RcServerClient::setJointSpeedLimits(const std::vector<JointSpeedLimit>& limits) {
  checkJointSpeedLimits(limits);
  command(loop_.get(), [&](CommandOutbox& outbox) { outbox.speed_limits.add(limits); });
}

bool RcServerClient::setMotors(bool on, milliseconds timeout, const OrderTerms& terms) {
  return waitFor(*loop_, "setMotors()", [&] { return beginMotors(on, timeout, terms); });
}

std::future<bool> RcServerClient::beginMotors(bool on, milliseconds timeout, const OrderTerms& terms) {
  Call call = callForMotors(on);
  if (on) {
    call.terms = {terms.not_after, 0};
  }
  return begin(loop_.get(), std::move(call), timeout, [](const Answer& answer) { return answer.motors_on; });
}

void RcServerClient::hold(const std::vector<int>& joints, milliseconds timeout) {
  waitFor(*loop_, "hold()", [&] { return beginHold(joints, timeout); });
}

std::future<void> RcServerClient::beginHold(const std::vector<int>& joints, milliseconds timeout) {
  checkJointsToHold(joints);
  return begin(loop_.get(), callToHold(joints), timeout, readNothing);
}

void RcServerClient::steer(const WalkVelocity& velocity, const OrderTerms& terms) {
  checkWalkVelocity(velocity);
  const WalkVelocity rounded = {wholeThousandths(velocity.forward), wholeThousandths(velocity.left),
                                wholeThousandths(velocity.turn)};
  loop_->change([&](Shared& shared) {
    loop_->requireConnection(shared);
    requireRequest(*loop_, shared, version2::STEER, version2::STEER.words, false);
    shared.commands.steer({rounded, terms, steering_bits_});
  });
}

void RcServerClient::guardWalks(bool on) {
  loop_->change([&](Shared&) { steering_bits_ = on ? version2::STEER_GUARDED : 0; });
}

void RcServerClient::takePosture(Posture posture, milliseconds timeout, const OrderTerms& terms) {
  waitFor(*loop_, "takePosture()", [&] { return beginPosture(posture, timeout, terms); });
}

std::future<void> RcServerClient::beginPosture(Posture posture, milliseconds timeout, const OrderTerms& terms) {
  Call call = callForPosture(toProtocol(posture));
  call.terms = terms;
  return begin(loop_.get(), std::move(call), timeout, readNothing);
}

void RcServerClient::commandLeds(const std::vector<LedCommand>& leds) {
  checkLedCommands(leds);
  command(loop_.get(), [&](CommandOutbox& outbox) { outbox.leds.add(leds); });
}

void RcServerClient::commandEars(bool left, bool right) {
  command(loop_.get(), [&](CommandOutbox& outbox) {
    outbox.ears.add({{EarCommand::kLeft, left}, {EarCommand::kRight, right}});
  });
}

std::string RcServerClient::playMotion(const std::string& name, int repetitions, milliseconds timeout,
                                       const OrderTerms& terms) {
  return waitFor(*loop_, "playMotion()", [&] { return beginMotion(name, repetitions, timeout, terms); });
}

std::future<std::string> RcServerClient::beginMotion(const std::string& name, int repetitions, milliseconds timeout,
                                                     const OrderTerms& terms) {
  checkRange("repetitions", repetitions, 1, 65535);
  Call call = callToPlay(checkedMotionName(name), repetitions, motion_bits_);
  call.terms = terms;
  return begin(loop_.get(), std::move(call), timeout, [](const Answer& answer) { return answer.changes; });
}

void RcServerClient::stopMotion(const std::string& name, milliseconds timeout) {
  ask(loop_.get(), callToStop(name.empty() ? name : checkedMotionName(name)), timeout, "stopMotion()");
}

void RcServerClient::uploadMotion(const std::string& name, const std::vector<std::uint8_t>& content,
                                  milliseconds timeout) {
  checkMotionContent(content);
  ask(loop_.get(), callToStore(checkedNewMotionName(name), content, motion_bits_), timeout, "uploadMotion()");
}

void RcServerClient::deleteMotion(const std::string& name, milliseconds timeout) {
  ask(loop_.get(), callToDelete(checkedMotionName(name)), timeout, "deleteMotion()");
}

std::vector<std::string> RcServerClient::listMotions(milliseconds timeout) {
  return ask(loop_.get(), callForMotions(), timeout, "listMotions()").names;
}

std::string RcServerClient::takePictureOnRobot(int quality, milliseconds timeout) {
  checkRange("quality", quality, 1, 100);
  return ask(loop_.get(), callToSavePicture(quality), timeout, "takePictureOnRobot()").names.at(0);
}

std::vector<std::string> RcServerClient::listPictures(milliseconds timeout) {
  return ask(loop_.get(), callForStickPictures(), timeout, "listPictures()").names;
}

std::vector<std::uint8_t> RcServerClient::fetchPicture(const std::string& name, milliseconds timeout) {
  Answer answer = ask(loop_.get(), callToFetchPicture(checkedPictureName(name)), timeout, "fetchPicture()");
  const JpegInspection found = inspectJpeg(answer.file.data(), answer.file.size());
  if (!found.good()) {
    throw CommandException(loop_->address() + " has sent " + name +
                           ", which is not a picture of its camera: " + found.problem + ".");
  }
  return std::move(answer.file);
}

void RcServerClient::deletePicture(const std::string& name, milliseconds timeout) {
  ask(loop_.get(), callToDeletePicture(checkedPictureName(name)), timeout, "deletePicture()");
}

void RcServerClient::shutDownRobot(milliseconds timeout) {
  ask(loop_.get(), callToGoOff(version2::SHUT_DOWN), timeout, "shutDownRobot()");
}

void RcServerClient::rebootRobot(milliseconds timeout) {
  ask(loop_.get(), callToGoOff(version2::REBOOT), timeout, "rebootRobot()");
}

SoundProgress RcServerClient::playSamples(std::uint64_t sound, const std::vector<std::int16_t>& samples, bool is_last,
                                          milliseconds timeout) {
  checkRange("samples", static_cast<long long>(samples.size()), 1, kMostSamplesAtOnce);
  const auto complete = [&](Shared* shared, Call* call) {
    setSamples(placeOf(samples.size(), sound, is_last, shared), samples, call);
  };
  return ask(loop_.get(), makeCall(version2::PLAY_SOUND), timeout, "playSamples()", complete).sound;
}

void RcServerClient::stopSound(milliseconds timeout) {
  const auto complete = [](Shared* shared, Call* /*call*/) { shared->sound = SoundPart(); };
  ask(loop_.get(), callToPlaySamples({0, 0, 0, true}, {}), timeout, "stopSound()", complete);
}

int RcServerClient::setVolume(int volume, milliseconds timeout) {
  if (volume != kVolumeOfRobot) {
    checkRange("volume", volume, 0, kLoudestVolume);
  }
  return ask(loop_.get(), callForVolume(volume), timeout, "setVolume()").volume;
}

void RcServerClient::setTelemetryPeriod(int frames) {
  checkRange("telemetry period", frames, 0, 65535, " frames");
  loop_->change([frames](Shared& shared) { shared.wish.telemetry_period = frames; });
}

MotorsAndPosture RcServerClient::motorsAndPosture() const {
  return loop_->read([](const Shared& shared) { return shared.motors_and_posture; });
}

ConnectionStatus RcServerClient::status() const {
  return loop_->read([](const Shared& shared) { return shared.status; });
}

std::string RcServerClient::robotDesign() const {
  return loop_->read([](const Shared& shared) { return shared.status.robot.design; });
}

ClientStatistics RcServerClient::statistics() const {
  return loop_->statistics();
}

}  // namespace aibo_client
