#include "node/body/telemetry_publishers.h"

#include <cstdint>
#include <utility>

#include "node/body/sensor_messages.h"

namespace aibo_driver::node {
namespace {

// The size of each subscriber's queue. This many messages can come at once after an outage of the radio
// (rcserver_client.h).
constexpr std::uint32_t kTelemetryQueueSize = 160;

constexpr const char* kBaseFrame = "base_link";

}  // namespace

TelemetryPublishers::TelemetryPublishers(const ros::NodeHandle& handle, const DriverParameters& parameters,
                                         const robot_model::RobotModel& model, const movement::JointTable& joint_table,
                                         const movement::MeasuredJoints& measured_joints, RobotStamper& stamper)
    : handle_(handle), parameters_(parameters), stamper_(stamper) {
  add("joint_states", "", JointStates(joint_table, measured_joints));
  const std::string range_prefix = "range_";
  for (int i = 0; i < model.number_of_sensors; ++i) {
    const robot_model::Sensor& sensor = model.sensors[i];
    const std::string name = sensor.name;
    if (sensor.kind == robot_model::SENSOR_DISTANCE) {
      add("range/" + name.substr(range_prefix.size()), name + "_link", RangeFinder(sensor));
    } else if (sensor.kind == robot_model::SENSOR_CHARGE) {
      add(name, kBaseFrame, Battery(sensor, sensorOf(model, "temperature")));
    }
  }
  add("touch", kBaseFrame, TouchSensors(model));
  add("imu/data_raw", "imu_link", Accelerometer(model));
}

void TelemetryPublishers::publish(const aibo_client::Telemetry& telemetry) {
  for (const auto& publisher : publishers_) {
    publisher(telemetry);
  }
}

template <typename Source>
void TelemetryPublishers::add(const std::string& topic, const std::string& frame, Source source) {
  using Message = typename Source::Message;
  const std::string frame_id = frame.empty() ? "" : parameters_.frame(frame);
  publishers_.push_back([this, publisher = handle_.advertise<Message>(topic, kTelemetryQueueSize), frame_id,
                         source = std::move(source)](const aibo_client::Telemetry& telemetry) mutable {
    const bool has_listeners = publisher.getNumSubscribers() > 0;
    if (!has_listeners && !Source::kRemembers) {
      return;
    }
    if (auto reading = source.read(telemetry); reading && has_listeners) {
      const auto message = boost::make_shared<Message>(std::move(*reading));
      message->header.stamp = stamper_.stamp(telemetry);
      message->header.frame_id = frame_id;
      publisher.publish(boost::shared_ptr<const Message>(message));
    }
  });
}

}  // namespace aibo_driver::node
