#include "aibo_client/rcserver_client.h"

#include <algorithm>
#include <functional>
#include <future>
#include <memory>
#include <utility>

#include "aibo_client/exceptions.h"
#include "aibo_client/jpeg_inspector.h"
#include "client/argument_checks.h"
#include "client/calls.h"
#include "client/connection_loop.h"
#include "client/units.h"
#include "client/version1_requests.h"
#include "protocol/file_list.h"
#include "protocol/motion_requests.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/walk_requests.h"

namespace aibo_client {

namespace version2 = protocol::version2;

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using Shared = ConnectionLoop::Shared;

namespace {

constexpr milliseconds kLongestTimeout{3600 * 1000};

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

/// Changes the shared state and a call when the call is handed over.
using Complete = std::function<void(Shared* shared, Call* call)>;

/// Hands a call to the client's thread.
/// @param complete may be empty
/// @throw the exceptions of RcServerClient::beginMotors(). If one is thrown, no call was handed over
void handOver(ConnectionLoop* loop, Call call, milliseconds timeout, const Complete& complete = {}) {
  checkRange("timeout", timeout.count(), 1, kLongestTimeout.count(), " ms");
  call.timeout = timeout;
  call.deadline = steady_clock::now() + timeout;
  loop->change([&](Shared& shared) {
    loop->requireConnection(shared);
    requireRequest(*loop, shared, call.request, describe(call), isKnownToVersion1(call));
    if (complete) {
      complete(&shared, &call);
    }
    shared.requests.emplace_back(
        [call = std::move(call)](Connection& connection) mutable { connection.add(std::move(call)); });
  });
}

/// Sends a request and begins to wait for its reply.
/// @tparam Reply the payload of the reply
/// @param read makes the result from the reply
/// @return a future: the result, or the exception that says why the call has failed
/// @throw the exceptions of handOver()
template <typename Reply, typename Read>
auto exchange(ConnectionLoop* loop, Call call, milliseconds timeout, const Read& read, const Complete& complete = {}) {
  auto result = expectReply<Reply>(&call, read);
  handOver(loop, std::move(call), timeout, complete);
  return result;
}

/// Does the same if the reply has no content.
std::future<void> exchange(ConnectionLoop* loop, Call call, milliseconds timeout, const Complete& complete = {}) {
  return exchange<AnyReply>(
      loop, std::move(call), timeout, [](const AnyReply&) {}, complete);
}

/// The loop, for a function that waits for the robot.
/// @throw Exception the function was called from a callback
ConnectionLoop* waitable(const std::unique_ptr<ConnectionLoop>& loop) {
  loop->read(ConnectionLoop::requireOtherThread);
  return loop.get();
}

/// Hands a command to the client's thread.
/// @param add called with the connection
template <typename Add>
void command(ConnectionLoop* loop, Add add) {
  loop->change([&](Shared& shared) {
    loop->requireConnection(shared);
    shared.requests.emplace_back(std::move(add));
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

bool leavesOutMissingJoints(const ConnectionLoop& loop) {
  return loop.read([](const Shared& shared) { return shared.wanted.leave_out_missing_joints; });
}

/// @name Replies that need more than their layout to be good
/// @{
struct MotionNames : public version2::FileList {};
const char* decode(const unsigned char* payload, std::size_t size, MotionNames* names) {
  return version2::decodeFileList(protocol::readMotionName, payload, size, names);
}

struct PictureNames : public version2::FileList {};
const char* decode(const unsigned char* payload, std::size_t size, PictureNames* names) {
  return version2::decodeFileList(protocol::readPictureName, payload, size, names);
}

struct VolumeInForce : public version2::Volume {};
const char* decode(const unsigned char* payload, std::size_t size, VolumeInForce* volume) {
  const char* const problem = version2::decode<version2::Volume>(payload, size, volume);
  return problem != nullptr || volume->step <= version2::MAX_VOLUME ? problem : "it does not say the volume in force";
}
/// @}

std::vector<std::string> namesIn(const version2::FileList& list) {
  return {list.names, list.names + list.count};
}

}  // namespace

RcServerClient::RcServerClient(const ClientOptions& options, Callbacks callbacks)
    : RcServerClient(options, std::move(callbacks), std::make_unique<TcpTransport>()) {}

RcServerClient::RcServerClient(const ClientOptions& options, Callbacks callbacks,
                               std::unique_ptr<TcpTransport> transport) {
  checkClientOptions(options);
  loop_ = std::make_unique<ConnectionLoop>(options, std::move(callbacks), std::move(transport));
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
  loop_->change([on](Shared& shared) { shared.wanted.streaming = on; });
}

void RcServerClient::setJpegQuality(int quality) {
  checkRange("jpeg_quality", quality, 1, 100);
  loop_->change([quality](Shared& shared) { shared.wanted.jpeg_quality = quality; });
}

int RcServerClient::jpegQuality() const {
  return loop_->read([](const Shared& shared) { return shared.wanted.jpeg_quality; });
}

void RcServerClient::setStreamFormat(const StreamFormat& format) {
  checkRange("every n-th image", format.every_nth_image, 1, 65535);
  loop_->change([&format](Shared& shared) { shared.wanted.format = format; });
}

StreamFormat RcServerClient::streamFormat() const {
  return loop_->read([](const Shared& shared) { return shared.wanted.format; });
}

void RcServerClient::setCameraSettings(const CameraSettings& settings) {
  checkRange("white balance", settings.white_balance, 1, 3);
  checkRange("gain", settings.gain, 1, 3);
  checkRange("shutter speed", settings.shutter_speed, 1, 3);
  loop_->change([&settings](Shared& shared) { shared.wanted.camera = settings; });
}

void RcServerClient::setPictureTransport(PictureTransport transport) {
  loop_->change([transport](Shared& shared) { shared.wanted.transport = transport; });
}

void RcServerClient::setColorDetection(const ColorDetection& detection) {
  checkRange("every n-th image", detection.every_nth_image, 1, 65535);
  loop_->change([&detection](Shared& shared) { shared.wanted.colors = detection; });
}

void RcServerClient::setColorTable(int channel, ColorTablePtr table) {
  checkRange("channel", channel, 0, kMostColorChannels - 1);
  if (table) {
    checkColorTable(*table);
  }
  loop_->change([channel, &table](Shared& shared) {
    shared.wanted.color_tables.at(static_cast<std::size_t>(channel)) = std::move(table);
  });
}

void RcServerClient::setMicrophone(const MicrophoneSettings& settings) {
  checkRange("channels", settings.channels, 1, 2);
  if (settings.samples_per_second != 8000 && settings.samples_per_second != 16000) {
    throw InvalidArgumentException("samples per second is " + std::to_string(settings.samples_per_second) +
                                   "; it must be 8000 or 16000");
  }
  loop_->change([&settings](Shared& shared) { shared.wanted.microphone = settings; });
}

bool RcServerClient::streaming() const {
  return loop_->read([](const Shared& shared) { return shared.streaming; });
}

PicturePtr RcServerClient::takePicture(int quality, milliseconds timeout, std::optional<Resolution> resolution) {
  Call call = callForPicture(quality, resolution);
  const auto promise = std::make_shared<std::promise<PicturePtr>>();
  auto result = promise->get_future();
  call.answer_with_picture = [promise](const PicturePtr& picture) { promise->set_value(picture); };
  call.fail = [promise](const std::exception_ptr& failure) { promise->set_exception(failure); };
  handOver(waitable(loop_), std::move(call), timeout);
  return result.get();
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
  command(loop_.get(), [limits, command = JointCommand{duration, targets, terms}](Connection& connection) {
    connection.limitSpeeds(limits);
    connection.commands.command(command);
  });
}

void RcServerClient::setJointSpeedLimits(const std::vector<JointSpeedLimit>& limits) {
  checkJointSpeedLimits(limits);
  command(loop_.get(), [limits](Connection& connection) { connection.limitSpeeds(limits); });
}

bool RcServerClient::setMotors(bool on, milliseconds timeout, const OrderTerms& terms) {
  waitable(loop_);
  return beginMotors(on, timeout, terms).get();
}

std::future<bool> RcServerClient::beginMotors(bool on, milliseconds timeout, const OrderTerms& terms) {
  Call call = callForMotors(on);
  if (on) {
    call.terms = {terms.not_after, 0};
  }
  return exchange<version2::MotorState>(loop_.get(), std::move(call), timeout,
                                        [](const auto& state) { return state.on; });
}

void RcServerClient::hold(const std::vector<int>& joints, milliseconds timeout) {
  waitable(loop_);
  beginHold(joints, timeout).get();
}

std::future<void> RcServerClient::beginHold(const std::vector<int>& joints, milliseconds timeout) {
  return exchange(loop_.get(), callToHold(joints), timeout);
}

void RcServerClient::steer(const WalkVelocity& velocity, const OrderTerms& terms) {
  checkWalkVelocity(velocity);
  const WalkVelocity rounded = {wholeThousandths(velocity.forward), wholeThousandths(velocity.left),
                                wholeThousandths(velocity.turn)};
  loop_->change([&](Shared& shared) {
    loop_->requireConnection(shared);
    requireRequest(*loop_, shared, version2::STEER, version2::STEER.words, false);
    const int options = shared.wanted.guard_walks ? version2::STEER_GUARDED : 0;
    shared.requests.emplace_back([command = SteeringCommand{rounded, terms, options}](Connection& connection) {
      connection.commands.steer(command);
    });
  });
}

void RcServerClient::guardWalks(bool on) {
  loop_->change([on](Shared& shared) { shared.wanted.guard_walks = on; });
}

void RcServerClient::takePosture(Posture posture, milliseconds timeout, const OrderTerms& terms) {
  waitable(loop_);
  beginPosture(posture, timeout, terms).get();
}

std::future<void> RcServerClient::beginPosture(Posture posture, milliseconds timeout, const OrderTerms& terms) {
  Call call = callForPosture(posture);
  call.terms = terms;
  return exchange(loop_.get(), std::move(call), timeout);
}

void RcServerClient::commandLeds(const std::vector<LedCommand>& leds) {
  checkLedCommands(leds);
  command(loop_.get(), [leds](Connection& connection) { connection.commands.leds.add(leds); });
}

void RcServerClient::commandEars(bool left, bool right) {
  command(loop_.get(), [left, right](Connection& connection) {
    connection.commands.ears.add({{EarCommand::kLeft, left}, {EarCommand::kRight, right}});
  });
}

std::string RcServerClient::playMotion(const std::string& name, int repetitions, milliseconds timeout,
                                       const OrderTerms& terms) {
  waitable(loop_);
  return beginMotion(name, repetitions, timeout, terms).get();
}

std::future<std::string> RcServerClient::beginMotion(const std::string& name, int repetitions, milliseconds timeout,
                                                     const OrderTerms& terms) {
  Call call = callToPlay(name, repetitions, leavesOutMissingJoints(*loop_));
  call.terms = terms;
  return exchange<version2::MotionChanges>(loop_.get(), std::move(call), timeout, [](const auto& changes) {
    return std::string(changes.text, changes.text_size);
  });
}

void RcServerClient::stopMotion(const std::string& name, milliseconds timeout) {
  exchange(waitable(loop_), callToStop(name), timeout).get();
}

void RcServerClient::uploadMotion(const std::string& name, const std::vector<std::uint8_t>& content,
                                  milliseconds timeout) {
  exchange(waitable(loop_), callToStore(name, content, leavesOutMissingJoints(*loop_)), timeout).get();
}

void RcServerClient::deleteMotion(const std::string& name, milliseconds timeout) {
  exchange(waitable(loop_), callToDelete(name), timeout).get();
}

std::vector<std::string> RcServerClient::listMotions(milliseconds timeout) {
  return exchange<MotionNames>(waitable(loop_), makeCall(version2::LIST_MOTIONS), timeout, &namesIn).get();
}

std::string RcServerClient::takePictureOnRobot(int quality, milliseconds timeout) {
  const auto read = [](const auto& picture) { return std::string(picture.name); };
  return exchange<version2::StickPicture>(waitable(loop_), callToSavePicture(quality), timeout, read).get();
}

std::vector<std::string> RcServerClient::listPictures(milliseconds timeout) {
  Call call = makeCall(version2::LIST_STICK_PICTURES, version2::NoPayload(), "", version2::LIST_PICTURES);
  return exchange<PictureNames>(waitable(loop_), std::move(call), timeout, &namesIn).get();
}

std::vector<std::uint8_t> RcServerClient::fetchPicture(const std::string& name, milliseconds timeout) {
  const auto read = [](const auto& file) { return Call::Bytes(file.content, file.content + file.size); };
  Call::Bytes file = exchange<version2::FetchedPicture>(waitable(loop_), callToFetchPicture(name), timeout, read).get();
  const JpegInspection found = inspectJpeg(file.data(), file.size());
  if (!found.good()) {
    throw CommandException(loop_->address() + " has sent " + name +
                           ", which is not a picture of its camera: " + found.problem + ".");
  }
  return file;
}

void RcServerClient::deletePicture(const std::string& name, milliseconds timeout) {
  exchange(waitable(loop_), callToDeletePicture(name), timeout).get();
}

void RcServerClient::shutDownRobot(milliseconds timeout) {
  exchange(waitable(loop_), makeCall(version2::SHUT_DOWN), timeout).get();
}

void RcServerClient::rebootRobot(milliseconds timeout) {
  exchange(waitable(loop_), makeCall(version2::REBOOT), timeout).get();
}

SoundProgress RcServerClient::playSamples(std::uint64_t sound, const std::vector<std::int16_t>& samples, bool is_last,
                                          milliseconds timeout) {
  checkRange("samples", static_cast<long long>(samples.size()), 1, kMostSamplesAtOnce);
  SoundProgress progress;
  const auto complete = [&](Shared* shared, Call* call) {
    const SoundPart part = placeOf(samples.size(), sound, is_last, shared);
    call->payload = callToPlaySamples(part, samples).payload;
    call->sound_part = part;
    progress.sound = part.sound;
  };
  const auto read = [](const auto& room) { return std::min(room.samples, version2::SPEAKER_CAPACITY); };
  progress.room =
      exchange<version2::SpeakerRoom>(waitable(loop_), callToPlaySamples({}, {}), timeout, read, complete).get();
  return progress;
}

void RcServerClient::stopSound(milliseconds timeout) {
  const auto complete = [](Shared* shared, Call* /*call*/) { shared->sound = SoundPart(); };
  exchange(waitable(loop_), callToPlaySamples({0, 0, 0, true}, {}), timeout, complete).get();
}

int RcServerClient::setVolume(int volume, milliseconds timeout) {
  const auto read = [](const auto& in_force) { return int{in_force.step}; };
  return exchange<VolumeInForce>(waitable(loop_), callForVolume(volume), timeout, read).get();
}

void RcServerClient::setTelemetryPeriod(int frames) {
  checkRange("telemetry period", frames, 0, 65535, " frames");
  loop_->change([frames](Shared& shared) { shared.wanted.telemetry_period = frames; });
}

MotorsAndPosture RcServerClient::motorsAndPosture() const {
  return loop_->read([](const Shared& shared) { return shared.motors_and_posture; });
}

ConnectionStatus RcServerClient::status() const {
  return loop_->status();
}

std::string RcServerClient::robotDesign() const {
  return loop_->read([](const Shared& shared) { return shared.status.robot.design; });
}

ClientStatistics RcServerClient::statistics() const {
  return loop_->statistics();
}

}  // namespace aibo_client
