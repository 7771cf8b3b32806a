#include "ros/aibo_driver.h"

#include <ros/console.h>

#include "ros/driver_namespace.h"
#include "ros/ros_log_sink.h"

namespace aibo_driver::node {
namespace {

void warnOfUnknown(const DriverParameters& parameters, const std::string& name_prefix) {
  for (const std::string& name : parameters.unknown) {
    ROS_WARN_STREAM("Parameter " << name_prefix << "/" << name
                                 << " is none of the driver's and is ignored: is it misspelt?");
  }
}

}  // namespace

AiboDriver::AiboDriver(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle, const std::string& name)
    : parameters_(readDriverParameters(private_handle)),
      model_(*robot_model::findRobotModel(parameters_.robot.c_str())),
      handle_(inDriverNamespace(handle, "aibo")),
      telemetry_stamper_(usedRobotClock(), parameters_.time_offset),
      power_(model_),
      policy_(
          parameters_.stream_on_start, parameters_.stream_on_demand, [this] { return cameraHasSubscribers(); },
          [this](bool on) { client_.setStreaming(on); }),
      connection_(handle_, parameters_.client),
      camera_(ros::NodeHandle(handle_, "camera"), parameters_, usedRobotClock(),
              [this] { policy_.subscribersChanged(); }),
      raw_images_(ros::NodeHandle(handle_, "camera"), "image_raw", [this] { policy_.subscribersChanged(); }),
      client_(parameters_.client, makeCallbacks()),
      services_(handle_, parameters_, client_, policy_, [this](const Picture& p) { return camera_.toMessage(p); }),
      joints_(handle_, parameters_, client_, [this](const Telemetry& t) { return telemetry_stamper_.stamp(t); }),
      body_(handle_, model_, client_, [this](const Telemetry& t) { return telemetry_stamper_.stamp(t); }),
      settings_(private_handle, settingTargets()),
      diagnostics_(handle_, private_handle, name,
                   {parameters_, client_, policy_, meter_, raw_images_, settings_, robot_clock_, power_}) {
  warnOfUnknown(parameters_, private_handle.getNamespace());
  policy_.start();
  client_.start();
}

// In a nodelet manager, subscribers come and go on other threads to the last: they must not reach what is gone already.
AiboDriver::~AiboDriver() {
  policy_.stop();
  client_.stop();
}

RcServerClient::Callbacks AiboDriver::makeCallbacks() {
  RcServerClient::Callbacks callbacks;
  callbacks.on_picture = [this](const PicturePtr& picture) { publishPicture(*picture); };
  callbacks.on_status = [this](const ConnectionStatus& status) { updateConnection(status); };
  callbacks.on_streaming = [this](bool streaming) { services_.publishStreaming(streaming); };
  callbacks.on_telemetry = [this](const Telemetry& telemetry) { publishTelemetry(telemetry); };
  callbacks.log = makeRosLogSink();
  return callbacks;
}

LiveSettings::Targets AiboDriver::settingTargets() {
  LiveSettings::Targets targets;
  targets.set_jpeg_quality = [this](int quality) { client_.setJpegQuality(quality); };
  targets.set_telemetry_period = [this](int frames) { client_.setTelemetryPeriod(frames); };
  targets.set_speed_scale = [this](double scale) { joints_.setSpeedScale(scale); };
  return targets;
}

void AiboDriver::publishPicture(const Picture& picture) {
  raw_images_.publish(camera_.publish(picture));
  meter_.add(picture.jpeg.size(), picture.first_byte_time);
}

void AiboDriver::publishTelemetry(const Telemetry& telemetry) {
  joints_.publishTelemetry(telemetry);
  body_.publishTelemetry(telemetry);
  power_.update(telemetry);
}

void AiboDriver::updateConnection(const ConnectionStatus& status) {
  connection_.publish(status);
  joints_.updateConnection(status);
  if (status.state != ConnectionState::kConnected) {
    power_.clear();
  }
}

bool AiboDriver::cameraHasSubscribers() const {
  return camera_.hasSubscribers() || raw_images_.hasSubscribers();
}

}  // namespace aibo_driver::node
