#include "client/version2_session.h"

#include <algorithm>
#include <array>
#include <utility>

#include "client/fault.h"
#include "client/version2_messages.h"
#include "protocol/big_endian.h"
#include "protocol/color_requests.h"
#include "protocol/hello.h"
#include "protocol/picture_datagram.h"
#include "protocol/sound_requests.h"
#include "robot_model/robot_model.h"

namespace aibo_client {

namespace version2 = protocol::version2;

namespace {

// The most reports that are kept. No robot has this many joints, and each report is kept once.
constexpr std::size_t kMostReports = 32;

// The kind of a push without a payload by which the server asks for a hello.
constexpr char kHelloWanted = 'h';

// Marks a setting that was not requested yet. No setting of the camera has this value.
constexpr int kNotRequested = -1;

template <typename Item>
std::vector<int> idsOf(const std::vector<Item>& items) {
  std::vector<int> ids(items.size());
  std::transform(items.begin(), items.end(), ids.begin(), [](const Item& item) { return item.id; });
  return ids;
}

template <typename Element, typename Predicate>
void removeIf(std::vector<Element>* elements, const Predicate& predicate) {
  elements->erase(std::remove_if(elements->begin(), elements->end(), predicate), elements->end());
}

/// True if the request can be an order that goes on after its answer.
bool isOrder(char letter) {
  return letter == version2::REQUEST_JOINTS || letter == version2::REQUEST_STEER ||
         letter == version2::REQUEST_POSTURE || letter == version2::REQUEST_PLAY;
}

}  // namespace

Version2Session::Version2Session(Connection& connection, TimePoint connected)
    : connection_(connection),
      buffer_(version2::MAX_PAYLOAD_TOWARDS_CLIENT),
      reader_(buffer_.data(), buffer_.size()),
      next_hello_(connected),
      datagrams_(connection.context),
      transport_(connection, datagrams_) {
  connection_.measurements.askedFor(telemetry_period_);
  camera_.fill(kNotRequested);
}

Session::Bytes Version2Session::nextRequest(const Settings& wanted, TimePoint now) {
  connection_.dropTooOld(now);
  Call* const stop = connection_.calls.nextStop();
  if (ready_ && stop != nullptr) {
    return requestCall(stop, now);
  }
  if (ready_ && connection_.commands.let_go) {
    return requestSteering(&connection_.commands.let_go, now);
  }
  if (now >= next_hello_) {
    return requestHello(now);
  }
  if (!ready_) {
    return {};
  }
  // The camera is set before the stream starts, so that its first picture has the settings. Tables of colours go before
  // the detection, so that the first push has all of them.
  using Self = Version2Session;
  for (const auto request_setting :
       {&Self::requestCameraSetting, &Self::requestTransport, &Self::requestStream, &Self::requestTelemetry,
        &Self::requestColorTable, &Self::requestColors, &Self::requestMicrophone}) {
    if (Bytes frame = (this->*request_setting)(wanted, now); !frame.empty()) {
      return frame;
    }
  }
  if (Call* const call = connection_.calls.nextForPicture()) {
    return requestPicture(wanted, call);
  }
  if (Call* const call = connection_.calls.nextForRobot(frames_.present(now).has_value())) {
    return connection_.mustWaitForSpeedLimits(*call) ? requestSpeedLimits(now) : requestCall(call, now);
  }
  return nextCommand(now);
}

Session::Bytes Version2Session::requestHello(TimePoint now) {
  next_hello_ = now + kHelloPeriod;
  return request(version2::SAY_HELLO, 0, {}, now, &Version2Session::onHello);
}

StreamFormat Version2Session::possibleFormat(const Settings& wanted) const {
  StreamFormat format = wanted.format;
  if (format.resolution == Resolution::kDouble && lacks_double_resolution_) {
    format.resolution = Resolution::kHigh;
  }
  return format;
}

Session::Bytes Version2Session::requestCameraSetting(const Settings& wanted, TimePoint now) {
  const auto values = valuesOf(wanted.camera);
  const auto different = std::mismatch(values.begin(), values.end(), camera_.begin());
  if (different.first == values.end()) {
    return {};
  }
  *different.second = *different.first;
  const auto id = static_cast<int>(different.first - values.begin()) + 1;
  const version2::CameraValue value = {static_cast<unsigned char>(id), static_cast<unsigned char>(*different.first)};
  return request(version2::SET_CAMERA, id, encoded(value), now);
}

Session::Bytes Version2Session::requestStream(const Settings& wanted, TimePoint now) {
  const PictureIntake& pictures = connection_.pictures;
  const StreamFormat format = possibleFormat(wanted);
  const bool is_as_wanted = wanted.jpeg_quality == pictures.streamQuality() && format == pictures.streamFormat();
  if (wanted.streaming == pictures.streaming() && (!wanted.streaming || is_as_wanted)) {
    return {};
  }
  connection_.pictures.streamRequested(wanted.streaming, wanted.jpeg_quality, now, format);
  datagrams_.expectFrom(now);
  const version2::StreamSettings settings = {wanted.streaming, layerOf(format.resolution),
                                             static_cast<unsigned short>(format.every_nth_image)};
  Bytes frame = request(version2::STREAM_PICTURES, wanted.jpeg_quality, encoded(settings), now);
  open_[last_number_].is_for_double_resolution = format.resolution == Resolution::kDouble;
  return frame;
}

Session::Bytes Version2Session::requestTransport(const Settings& wanted, TimePoint now) {
  const std::optional<version2::DatagramOrder> order = transport_.next(wanted, now);
  return order ? request(version2::SEND_DATAGRAMS, 0, encoded(*order), now, &Version2Session::onDatagrams) : Bytes();
}

Session::Bytes Version2Session::requestPicture(const Settings& wanted, Call* call) {
  const int quality = call->quality == 0 ? wanted.jpeg_quality : call->quality;
  const Resolution resolution = call->resolution.value_or(possibleFormat(wanted).resolution);
  Bytes frame = makeFrame(call->request.letter, quality, encoded(version2::PictureRequest{layerOf(resolution)}));
  call->request_number = last_number_;
  return frame;
}

Session::Bytes Version2Session::requestTelemetry(const Settings& wanted, TimePoint now) {
  if (wanted.telemetry_period == telemetry_period_) {
    return {};
  }
  telemetry_period_ = wanted.telemetry_period;
  connection_.measurements.askedFor(telemetry_period_);
  const version2::TelemetryPeriod period = {static_cast<unsigned short>(wanted.telemetry_period)};
  return request(version2::SEND_TELEMETRY, version2::TELEMETRY_WITH_DUTY, encoded(period), now);
}

Session::Bytes Version2Session::requestColorTable(const Settings& wanted, TimePoint now) {
  if (!wanted.colors.on || wanted.color_tables == color_tables_) {
    return {};
  }
  const auto different = std::mismatch(wanted.color_tables.begin(), wanted.color_tables.end(), color_tables_.begin());
  const ColorTablePtr& chosen = *different.second = *different.first;
  const version2::ColorTable table = tableOf(chosen, different.first - wanted.color_tables.begin());
  return request(version2::DETECT_COLORS, version2::COLORS_TABLE, encoded(table), now);
}

Session::Bytes Version2Session::requestColors(const Settings& wanted, TimePoint now) {
  if (wanted.colors == connection_.colors.detection()) {
    return {};
  }
  connection_.colors.askedFor(wanted.colors);
  const version2::ColorSettings settings = {static_cast<unsigned short>(wanted.colors.every_nth_image),
                                            wanted.colors.with_mask};
  return wanted.colors.on ? request(version2::DETECT_COLORS, version2::COLORS_ON, encoded(settings), now)
                          : request(version2::DETECT_COLORS, version2::COLORS_OFF, {}, now);
}

// The microphones need not be switched off at first, because a server starts with them off.
Session::Bytes Version2Session::requestMicrophone(const Settings& wanted, TimePoint now) {
  const MicrophoneSettings& microphone = wanted.microphone;
  const MicrophoneSettings& asked = connection_.sound.asked();
  if (microphone == asked || (!microphone.on && !asked.on && microphone.before_pictures == asked.before_pictures)) {
    return {};
  }
  connection_.sound.askedFor(microphone);
  const unsigned mode = (microphone.on ? unsigned{version2::MICROPHONE_ON} : 0) |
                        (microphone.before_pictures ? unsigned{version2::SOUND_FIRST} : 0);
  const version2::MicrophoneSettings settings = {static_cast<unsigned char>(mode),
                                                 static_cast<unsigned char>(microphone.channels),
                                                 static_cast<unsigned short>(microphone.samples_per_second)};
  return request(version2::LISTEN, version2::SOUND_MICROPHONE, encoded(settings), now, &Version2Session::onMicrophone);
}

Session::Bytes Version2Session::requestCall(Call* call, TimePoint now) {
  if (call->terms) {
    protocol::encodeBigEndian32(frames_.notAfter(call->terms->not_after, now).value(), call->payload.data());
  }
  Bytes frame = makeFrame(call->request.letter, call->id, call->payload);
  call->request_number = last_number_;
  if (call->has(version2::STARTS_MOVEMENT)) {
    remember({call->request, {}, call->order()});
  }
  connection_.callSent(*call, frame.size(), now);
  return frame;
}

long Version2Session::outstanding(char kind) const {
  return std::count_if(open_.begin(), open_.end(), [kind](const auto& each) {
    return each.second.request.letter == kind && each.second.deadline != TimePoint::max();
  });
}

bool Version2Session::mayCommandJoints() const {
  return outstanding(version2::REQUEST_JOINTS) + outstanding(version2::REQUEST_SPEED_LIMITS) <
         kMostJointCommandsOutstanding;
}

Session::Bytes Version2Session::nextCommand(TimePoint now) {
  CommandOutbox& commands = connection_.commands;
  const bool may_order = frames_.present(now).has_value();
  if (commands.steering && may_order && commands.speed_limits.empty() && outstanding(version2::REQUEST_STEER) == 0) {
    return requestSteering(&commands.steering, now);
  }
  if (mayCommandJoints()) {
    if (!commands.speed_limits.empty()) {
      return requestSpeedLimits(now);
    }
    if (!commands.joints.empty() && may_order) {
      return requestTargets(now);
    }
  }
  if (!commands.leds.empty() && outstanding(version2::REQUEST_LEDS) == 0) {
    return requestLeds(now);
  }
  if (!commands.ears.empty() && outstanding(version2::REQUEST_EARS) == 0) {
    return requestEars(now);
  }
  return {};
}

Session::Bytes Version2Session::requestSpeedLimits(TimePoint now) {
  const std::vector<JointSpeedLimit> wanted = connection_.commands.speed_limits.take(version2::MAX_JOINTS);
  return request(version2::LIMIT_SPEEDS, 0, encoded(limitsOf(wanted)), now, nullptr, idsOf(wanted));
}

Session::Bytes Version2Session::requestTargets(TimePoint now) {
  const JointCommand command = connection_.commands.joints.takeCommand();
  const version2::JointOrder order = {frames_.notAfter(command.terms.not_after, now).value(), targetsOf(command)};
  return request(version2::MOVE_JOINTS, 0, encoded(order), now, &Version2Session::onJointsAccepted,
                 idsOf(command.targets), command.terms.number);
}

/// @param command must have a value. A velocity of 0 is sent even if the robot's frame is not known
Session::Bytes Version2Session::requestSteering(std::optional<SteeringCommand>* command, TimePoint now) {
  const SteeringCommand taken = *std::exchange(*command, std::nullopt);
  const WalkVelocity& wanted = taken.velocity;
  const version2::SteeringOrder order = {frames_.notAfter(taken.terms.not_after, now).value_or(0),
                                         {wanted.forward, wanted.left, wanted.turn}};
  return request(version2::STEER, taken.options, encoded(order), now, &Version2Session::onSteered, {},
                 taken.terms.number);
}

Session::Bytes Version2Session::requestLeds(TimePoint now) {
  const std::vector<LedCommand> wanted = connection_.commands.leds.take(version2::MAX_LEDS);
  return request(version2::SET_LEDS, 0, encoded(ledsOf(wanted)), now, &Version2Session::onLedsAccepted, idsOf(wanted));
}

// Both ears are always commanded together.
Session::Bytes Version2Session::requestEars(TimePoint now) {
  const std::vector<EarCommand> wanted = connection_.commands.ears.take(2);
  version2::EarPositions positions = {};
  for (const EarCommand& ear : wanted) {
    (ear.id == EarCommand::kLeft ? positions.left : positions.right) = ear.drawn;
  }
  return request(version2::MOVE_EARS, 0, encoded(positions), now, nullptr, idsOf(wanted));
}

/// A request whose answer is due soon.
Session::Bytes Version2Session::request(const version2::Request& request, int id, const Bytes& payload, TimePoint now,
                                        OnAnswer on_answer, const std::vector<int>& ids, std::uint64_t order) {
  Bytes frame = makeFrame(request.letter, id, payload);
  remember({request, ids, order, connection_.answerDeadline(now), on_answer});
  return frame;
}

/// Remembers the request that was made last.
void Version2Session::remember(const OpenRequest& request) {
  if (open_.size() >= kMostOpenRequests) {
    throw ProtocolException("it has ended none of " + std::to_string(kMostOpenRequests) + " orders");
  }
  open_[last_number_] = request;
}

Session::Bytes Version2Session::makeFrame(char kind, int id, const Bytes& payload) {
  last_number_ = nextNumber();
  const version2::FrameHeader header = {kind, static_cast<unsigned char>(id), static_cast<unsigned short>(last_number_),
                                        static_cast<unsigned>(payload.size())};
  Bytes frame(version2::FRAME_HEADER_SIZE + payload.size());
  version2::encode(header, frame.data());
  std::copy(payload.begin(), payload.end(), frame.begin() + version2::FRAME_HEADER_SIZE);
  return frame;
}

int Version2Session::nextNumber() {
  int number = last_number_;
  do {
    number = number % 65535 + 1;
  } while (kindOf(number));
  return number;
}

/// @return the kind of the request with this number, if its answer or its end is awaited
std::optional<char> Version2Session::kindOf(int number) const {
  if (const auto open = open_.find(number); open != open_.end()) {
    return open->second.request.letter;
  }
  const Call* const call = connection_.calls.find(number);
  return call != nullptr ? std::optional<char>(call->request.letter) : std::nullopt;
}

/// @param number the number of a request, or 0
/// @return OrderTerms::number; 0 if there is none
std::uint64_t Version2Session::orderOf(int number) const {
  const auto open = open_.find(number);
  return open == open_.end() ? 0 : open->second.order;
}

void Version2Session::bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now) {
  now_ = now;
  datagrams_.heardByTcp(now);
  while (size > 0) {
    if (reader_.isBetweenFrames()) {
      frame_began_ = now;
    }
    std::size_t taken = 0;
    const version2::FrameReader::Result result = reader_.append(data, size, &taken);
    data += taken;
    size -= taken;
    if (result == version2::FrameReader::FRAME_TOO_LARGE) {
      throw ProtocolException("a frame of " + std::to_string(reader_.header().payload_size) + " bytes; at most " +
                              std::to_string(version2::MAX_PAYLOAD_TOWARDS_CLIENT) + " are possible");
    }
    if (result == version2::FrameReader::FRAME_COMPLETE) {
      onFrame();
    }
  }
  if (!reader_.isBetweenFrames()) {
    connection_.pictures.signOfPicture(now);  // nothing else is so large that it comes in parts
  }
  connection_.colors.deliver();
}

bool Version2Session::datagramArrived(const std::uint8_t* data, std::size_t size, TimePoint now) {
  now_ = now;
  if (!datagrams_.on()) {
    transport_.arrived(data, size);
    return false;
  }
  const bool is_robots = datagrams_.arrived(data, size, now);
  if (auto whole = datagrams_.takeWhole()) {
    const auto picture = inspect(std::move(whole->jpeg), whole->header, whole->began);
    if (picture && !isOfTheFuture(whole->header.frame_number)) {
      datagrams_.goodPicture(whole->number, now);
      deliverFromStream(picture);
    }
  }
  return is_robots;
}

void Version2Session::onFrame() {
  const version2::FrameHeader& header = reader_.header();
  const Payload payload = {reader_.payload(), header.payload_size};
  if (header.kind < 'a' || header.kind > 'z') {
    throw ProtocolException("a frame that begins with byte " + std::to_string(static_cast<unsigned char>(header.kind)));
  }
  if (header.request_number == 0) {
    onPush(header.kind, payload);
  } else {
    onReply(header.kind, header.request_number, payload);
  }
}

// Pushes of unknown kinds are ignored, because they are for newer clients.
void Version2Session::onPush(char kind, const Payload& payload) {
  switch (kind) {
    case version2::PICTURE:
      return onStreamPicture(payload);
    case version2::TELEMETRY_PUSH:
      return onTelemetry(payload);
    case version2::COLORS_PUSH:
      return onColors(payload);
    case version2::SOUND_PUSH:
      return onSound(payload);
    case version2::END_PUSH:
      return onEnded(payload);
    case kHelloWanted:
      next_hello_ = now_;
      return;
    case version2::ERROR_MESSAGE:
      return onReport(payload);
    case version2::MOTORS_AND_POSTURE_PUSH:
      return onMotorsAndPosture(payload);
    default:
      return;
  }
}

void Version2Session::onReply(char kind, int number, const Payload& payload) {
  const std::optional<char> request_kind = kindOf(number);
  if (!request_kind) {
    return;  // the caller does not wait any more
  }
  if (version2::isError(kind, payload.size)) {
    onError(number, payload);
  } else if (kind != version2::replyKind(*request_kind)) {
    throw ProtocolException(std::string("a reply '") + kind + "' to the request '" + *request_kind + "'");
  } else {
    if (const Call* const call = connection_.calls.find(number)) {
      call->isForPicture() ? onRequestedPicture(number, payload) : onCallAnswered(*call, payload);
    } else if (const OnAnswer on_answer = open_.at(number).on_answer) {
      (this->*on_answer)(payload);
    }
    onAnswered(number);
  }
}

/// An order goes on after its answer.
void Version2Session::onAnswered(int number) {
  const auto open = open_.find(number);
  if (open != open_.end() && isOrder(open->second.request.letter)) {
    open->second.deadline = TimePoint::max();
    open->second.on_answer = nullptr;
  } else if (open != open_.end()) {
    open_.erase(open);
  }
}

void Version2Session::onHello(const Payload& payload) {
  version2::Hello hello;
  expectGood(version2::decodeHello(payload.data, payload.size, &hello), "hello");
  if (!ready_) {  // later hellos are only heartbeats
    connection_.status.robot = robotIn(hello);
  }
  frames_.told(hello.frame_number, now_);
  ready_ = true;
}

std::shared_ptr<Picture> Version2Session::takePictureFrom(const Payload& payload) {
  connection_.pictures.signOfPicture(now_);
  const auto picture = decoded<version2::PicturePayload>(payload.data, payload.size, "picture");
  frames_.told(picture.header.frame_number, now_);
  return inspect(Bytes(picture.jpeg, picture.jpeg + picture.jpeg_size), picture.header, frame_began_);
}

/// @return null if it is damaged
std::shared_ptr<Picture> Version2Session::inspect(Bytes jpeg, const version2::ImageHeader& header, TimePoint began) {
  std::shared_ptr<Picture> picture = connection_.pictures.inspect(std::move(jpeg), began);
  if (picture) {
    picture->quality = header.quality;
    picture->frame_number = header.frame_number;
    picture->image_count = header.image_count;
    picture->settings = settingsIn(header.settings);
  }
  return picture;
}

void Version2Session::onStreamPicture(const Payload& payload) {
  if (const PicturePtr picture = takePictureFrom(payload)) {
    deliverFromStream(picture);
  }
}

void Version2Session::deliverFromStream(const PicturePtr& picture) {
  if (isOvertaken(*picture)) {
    ++connection_.context.counters.stale_pictures;
  } else if (connection_.pictures.deliverFromStream(picture, now_)) {
    newest_frame_ = picture->frame_number;
  }
}

// Protects against a forged frame number, which would make all later pictures look overtaken. What comes by TCP may be
// late, but if it were later than an answer may be, there would be no connection.
bool Version2Session::isOfTheFuture(std::uint32_t frame_number) const {
  const std::optional<std::uint32_t> present = frames_.present(now_);
  const auto most_ahead = connection_.answerLimit() / std::chrono::milliseconds(robot_model::FRAME_MILLISECONDS);
  return present && static_cast<std::int32_t>(frame_number - *present) > most_ahead;
}

// Pictures by TCP and pictures by UDP may overtake each other.
bool Version2Session::isOvertaken(const Picture& picture) const {
  return datagrams_.wereUsed() && newest_frame_ && picture.frame_number &&
         static_cast<std::int32_t>(*picture.frame_number - *newest_frame_) <= 0;
}

void Version2Session::onRequestedPicture(int number, const Payload& payload) {
  const PicturePtr picture = takePictureFrom(payload);
  if (!picture) {
    connection_.calls.find(number)->request_number = 0;  // the request is sent again if the call's time allows
    return;
  }
  const PictureIntake& pictures = connection_.pictures;
  const std::optional<Resolution>& resolution = connection_.calls.find(number)->resolution;
  const bool is_of_other_size = pictures.streaming() && resolution && *resolution != pictures.streamFormat().resolution;
  if (is_of_other_size || isOvertaken(*picture)) {
    ++connection_.context.counters.pictures;  // on_picture is not called: it does not fit into the stream
  } else {
    newest_frame_ = picture->frame_number;
    connection_.pictures.deliver(picture);
  }
  connection_.calls.answer(number, picture);
}

void Version2Session::onTelemetry(const Payload& payload) {
  const auto measured = decoded<version2::Telemetry>(payload.data, payload.size, "telemetry");
  frames_.told(measured.frame_number, now_);
  Telemetry telemetry = telemetryIn(measured, connection_.status.robot.design);
  telemetry.arrival = frame_began_;
  connection_.measurements.deliver(std::move(telemetry), connection_.status.robot.design);
}

// Until the robot has answered, colours may still be those of the old tables, and would get the names of the new ones.
void Version2Session::onColors(const Payload& payload) {
  if (outstanding(version2::REQUEST_COLORS) == 0) {
    connection_.colors.receive(payload.data, payload.size, color_tables_, frame_began_);
  }
}

void Version2Session::onJointsAccepted(const Payload& payload) {
  const auto accepted = decoded<version2::JointTargets>(payload.data, payload.size, "reply to joint targets");
  connection_.context.notifier.tell(&Callbacks::on_joints_accepted, "on_joints_accepted", targetsIn(accepted));
}

void Version2Session::onLedsAccepted(const Payload& payload) {
  const auto accepted = decoded<version2::LedValues>(payload.data, payload.size, "reply to LEDs");
  connection_.context.notifier.tell(&Callbacks::on_leds_accepted, "on_leds_accepted", ledsIn(accepted));
}

void Version2Session::onSteered(const Payload& payload) {
  const auto steered = decoded<version2::SteeringReply>(payload.data, payload.size, "reply to steering");
  bodyMovesAgain();
  const int number = reader_.header().request_number;
  const std::uint64_t order = orderOf(number);
  if (steered.walk != number) {
    open_.erase(number);  // the order began no walk
  }
  const version2::Velocity& velocity = steered.velocity;
  connection_.context.notifier.tell(&Callbacks::on_steered, "on_steered",
                                    {velocity.forward, velocity.left, velocity.turn}, order, orderOf(steered.walk));
}

void Version2Session::onSound(const Payload& payload) {
  if (reader_.header().id == version2::SOUND_MICROPHONE) {
    connection_.sound.heard(payload.data, payload.size, frame_began_);
  } else if (reader_.header().id == version2::SOUND_SPEAKER) {
    connection_.sound.ended(payload.data, payload.size);
  }
}

void Version2Session::onMicrophone(const Payload& payload) {
  const auto settings =
      decoded<version2::MicrophoneSettings>(payload.data, payload.size, "reply to a request to listen");
  if (outstanding(version2::REQUEST_SOUND) == 1) {  // otherwise newer settings are still to be answered
    connection_.sound.inForce({(settings.mode & version2::MICROPHONE_ON) != 0, settings.channels,
                               settings.samples_per_second, (settings.mode & version2::SOUND_FIRST) != 0});
  }
}

void Version2Session::onDatagrams(const Payload& payload) {
  transport_.answered(decoded<version2::DatagramOrder>(payload.data, payload.size, "reply to an order of datagrams"),
                      now_);
}

// Ends that the request has caused are reported before the caller gets the answer.
void Version2Session::onCallAnswered(const Call& call, const Payload& payload) {
  if (call.has(version2::MOVES_BODY)) {
    bodyMovesAgain();
  }
  if (call.sound_part) {
    connection_.sound.accepted(*call.sound_part);
  } else if (call.has(version2::NEEDS_MEMORY_STICK)) {
    connection_.calls.transferEnds(now_);
  }
  connection_.calls.answer(call.request_number, payload.data, payload.size);
}

/// Reports that the robot has refused a request. The caller may have stopped waiting for it.
void Version2Session::onError(int number, const Payload& payload) {
  const auto message = decoded<version2::ErrorMessage>(payload.data, payload.size, "error message");
  const std::string problem = describe(message);
  const RefusalCause cause = message.code == version2::CODE_TOO_OLD ? RefusalCause::kTooOld : RefusalCause::kRobot;
  const auto refused = open_.extract(number);
  if (const Call* const call = connection_.calls.find(number)) {
    connection_.refuse(*call, cause, problem, now_);
  } else {
    onRefusal(refused.mapped(), cause, problem);
  }
}

void Version2Session::onRefusal(const OpenRequest& refused, RefusalCause cause, const std::string& problem) {
  const char letter = refused.request.letter;
  if (letter == version2::REQUEST_SPEED_LIMITS) {
    connection_.forgetSpeedLimits(refused.ids);
  }
  if (const std::optional<RefusedRequest> kind = refusedRequest(letter)) {
    return connection_.refused(Refusal{*kind, cause, refused.ids, problem, refused.order});
  }
  const std::string what = std::string("to ") + refused.request.words;
  if (letter == version2::REQUEST_HELLO) {
    throw ProtocolException("it refused " + what + ": " + problem);
  }
  if (refused.is_for_double_resolution) {
    lacks_double_resolution_ = true;  // if the stream is still wanted, it is requested again at single resolution
    return connection_.context.warnOnce(
        "double resolution", "refused to stream pictures of double resolution; they have 208x160 pixels: " + problem);
  }
  if (letter == version2::REQUEST_STREAM) {
    throw ProtocolException("it refused " + what + ": " + problem);
  }
  if (letter == version2::REQUEST_DATAGRAMS) {
    ++connection_.context.counters.refusals;
    if (outstanding(letter) == 0) {  // otherwise the robot has refused an earlier order
      transport_.refused(problem, now_);
    }
    return;
  }
  connection_.refused(what + ": " + problem);
}

void Version2Session::onEnded(const Payload& payload) {
  const auto message = decoded<version2::EndMessage>(payload.data, payload.size, "report of an end");
  ActivityEnd end = endIn(message);
  end.order = orderOf(message.order);
  open_.erase(message.order);
  if (end.kind == EndedKind::kJam) {
    jointFollowsAgain(end.name);
  }
  connection_.context.notifier.tell(&Callbacks::on_ended, "on_ended", end);
}

void Version2Session::onReport(const Payload& payload) {
  const auto message = decoded<version2::ErrorMessage>(payload.data, payload.size, "error message");
  const Report report = {describe(message), message.code == version2::CODE_JOINT_FAULT,
                         message.code == version2::CODE_REFUSED};
  removeIf(&reports_, [&report](const Report& each) { return each.text == report.text; });
  reports_.push_back(report);
  if (reports_.size() > kMostReports) {
    reports_.erase(reports_.begin());
  }
  connection_.status.robot_message = report.text;
  connection_.goes_off = message.code == version2::CODE_POWER ? report.text : connection_.goes_off;
  connection_.context.warn("reports: " + report.text);
}

void Version2Session::onMotorsAndPosture(const Payload& payload) {
  const auto state = decoded<version2::MotorsAndPosture>(payload.data, payload.size, "state of motors and posture");
  connection_.motors_and_posture = stateIn(state);
}

// A report of a joint's fault begins with the name of the joint.
void Version2Session::jointFollowsAgain(const std::string& joint) {
  removeIf(&reports_,
           [&joint](const Report& each) { return each.joint_fault && each.text.rfind(joint + " ", 0) == 0; });
  connection_.status.robot_message = reports_.empty() ? "" : reports_.back().text;
  connection_.context.notifier.log(LogLevel::kInfo, "The joint " + joint + " follows its commands again.");
}

// Removes the reports of what kept the robot from walking.
void Version2Session::bodyMovesAgain() {
  removeIf(&reports_, [](const Report& each) { return each.about_body; });
  connection_.status.robot_message = reports_.empty() ? "" : reports_.back().text;
}

Session::TimePoint Version2Session::answerDeadline() const {
  TimePoint oldest = TimePoint::max();
  for (const auto& each : open_) {
    oldest = std::min(oldest, each.second.deadline);
  }
  return oldest;
}

void Version2Session::checkDeadlines(TimePoint now) {
  const ConnectionContext& context = connection_.context;
  if (connection_.pictures.streaming() && now >= pictureDeadline()) {
    const std::string problem = datagrams_.problem(now, connection_.pictures.extraInterval());
    if (problem.empty()) {
      throw Fault::silent(context.address, context.read_timeout);
    }
    transport_.giveUp(problem, now);
  }
  for (const auto& each : open_) {
    if (now >= each.second.deadline) {
      throw Fault::unanswered(context.address, std::string("the request '") + each.second.request.letter + "'",
                              connection_.answerLimit());
    }
  }
  connection_.expireCalls(now);
}

/// The time at which the robot, or its datagrams, will have been silent for too long. With UDP the radio may be out for
/// longer than with TCP, because pictures come at once when it is back, without a new connection.
Session::TimePoint Version2Session::pictureDeadline() const {
  return datagrams_.on() ? datagrams_.deadline(connection_.pictures.extraInterval()) : connection_.pictureDeadline();
}

Session::TimePoint Version2Session::nextDeadline() const {
  const PictureIntake& pictures = connection_.pictures;
  const TimePoint silence = pictures.streaming() ? pictureDeadline() : TimePoint::max();
  return std::min({silence, answerDeadline(), connection_.calls.nextDeadline(), next_hello_, pictures.nextLook(),
                   datagrams_.nextLook(), transport_.nextLook()});
}

}  // namespace aibo_client
