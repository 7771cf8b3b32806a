#include "remote_control/ros_robot.h"

#include <aibo_driver/ListMotions.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/PlaySound.h>
#include <aibo_driver/Say.h>
#include <aibo_driver/StopMotion.h>
#include <aibo_driver/TakePicture.h>
#include <aibo_driver/UploadMotion.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/names.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <QDateTime>
#include <QDir>
#include <type_traits>
#include <utility>

#include "aibo_client/options.h"
#include "files/files.h"
#include "remote_control/messages.h"

namespace aibo_driver::remote_control {
namespace {

constexpr std::chrono::milliseconds kSearchPeriod{2000};

/// Saves a JPEG, with the time in the file's name.
/// @return the path of the file
/// @throw std::runtime_error the picture was not saved; the message says why
QString savePicture(const std::vector<std::uint8_t>& jpeg, const QString& folder) {
  const QString name = "aibo_" + QDateTime::currentDateTime().toString("yyyy-MM-dd_HH-mm-ss.zzz") + ".jpg";
  QDir().mkpath(folder);
  try {
    return QString::fromStdString(files::saveJpeg("/", QDir(folder).absoluteFilePath(name).toStdString(), jpeg));
  } catch (const files::FileException& why) {
    throw std::runtime_error("the picture was taken, but not saved in " + folder.toStdString() + ": " + why.what() +
                             ". Choose another folder.");
  }
}

RobotConnection::State toState(std::uint8_t state) {
  switch (state) {
    case aibo_driver::Connection::CONNECTED:
      return RobotConnection::State::kConnected;
    case aibo_driver::Connection::CONNECTING:
      return RobotConnection::State::kConnecting;
    case aibo_driver::Connection::PLAYBACK:
      return RobotConnection::State::kPlayback;
    default:
      return RobotConnection::State::kDisconnected;
  }
}

QString noMasterText() {
  return "the ROS master at " + QString::fromStdString(ros::master::getURI()) + " does not answer: is roscore running?";
}

QString noDriverText(const QString& name_space) {
  return name_space.isEmpty() ? QString("no driver is running: start one with roslaunch aibo_driver aibo.launch")
                              : "the driver in " + name_space + " does not answer: is it running?";
}

QString noAnswerText(const std::string& service) {
  return "no answer from the service " + fromRos(service) + ": are the driver and the ROS master running?";
}

}  // namespace

RosRobot::RosRobot(QObject* parent) : Robot(parent) {
  connection_.text = "no driver has been found yet";
  manager_ = std::thread(&RosRobot::manageTopics, this);  // last, because the thread uses all members above
}

RosRobot::~RosRobot() {
  calls_.cancel();
  wish([](Wishes& wishes) { wishes.end = true; });
  manager_.join();
  topics_.reset();  // the topics must end before their queues
}

// The functions below run on the thread that asks the master.

void RosRobot::wish(const std::function<void(Wishes&)>& change) {
  const std::lock_guard<std::mutex> lock(mutex_);
  change(wishes_);
  changed_.notify_all();
}

void RosRobot::manageTopics() {
  auto next_search = std::chrono::steady_clock::now();
  Wishes wishes;
  while (!wishes.end) {
    if (std::chrono::steady_clock::now() >= next_search) {
      search();
      next_search = std::chrono::steady_clock::now() + kSearchPeriod;
    }
    if (master_answers_ && !ros::isShuttingDown()) {  // without a master, roscpp would wait until it answers
      if (!ros::isStarted()) {
        ros::start();
      }
      const std::string chosen = wishes.name_space.empty() ? findDriver() : wishes.name_space;
      if (chosen != name_space_) {
        useTopicsOf(chosen);
      }
      if (topics_) {
        topics_->show(wishes.visible);
      }
    }
    reportConnection();
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_until(lock, next_search, [this, &wishes] { return connection_changed_ || !(wishes_ == wishes); });
    connection_changed_ = false;
    if (!(wishes_ == wishes)) {
      next_search = {};  // the master has fallen silent meanwhile, and roscpp would wait for it
    }
    wishes = wishes_;
  }
}

// The master may know drivers that do not run any more. So a driver that is never heard is given up, and the next is
// tried. A driver that was heard stays, because a user who presses STOP means the robot that the window has shown.
std::string RosRobot::findDriver() const {
  if (topics_ && (topics_->areNew() || topics_->wasHeard())) {
    return name_space_;
  }
  return driverAfter(name_space_, found_drivers_);
}

void RosRobot::search() {
  const std::optional<TopicTypes> types = askMaster();
  master_answers_ = types.has_value();
  if (!types) {
    return;
  }
  const std::vector<std::string> found = driversIn(*types);
  if (found != std::exchange(found_drivers_, found)) {
    post([drivers = fromRos(found)](Robot& robot) { Q_EMIT robot.driversFound(drivers); });
  }
}

// Forgets what the old driver has reported, which is not true of the new one and might never be replaced.
void RosRobot::forgetDriver(const std::string& next) {
  RobotConnection waits;
  waits.state = RobotConnection::State::kWaiting;
  waits.name_space = fromRos(next);
  waits.text = "waiting for the driver in " + waits.name_space;
  report(waits);
  post([](Robot& robot) {
    Q_EMIT robot.conditionChanged({});
    Q_EMIT robot.streamingChanged(false);
    Q_EMIT robot.movementChanged("");
    Q_EMIT robot.ledsChanged({});
    Q_EMIT robot.settingsDescribed({});
    Q_EMIT robot.settingsChanged({});
  });
}

void RosRobot::useTopicsOf(const std::string& name_space) {
  std::shared_ptr<DriverTopics> old;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    old = std::exchange(topics_, nullptr);
  }
  // The window may just be publishing. It must not be the last owner, or it might have to wait for the master.
  while (old.use_count() > 1) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  old.reset();  // waits for the topics' callbacks, of which none comes from now on
  forgetDriver(name_space);
  const auto made = std::make_shared<DriverTopics>(name_space, &queue_, &measurements_, *this, [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    connection_changed_ = true;
    changed_.notify_all();
  });
  const std::lock_guard<std::mutex> lock(mutex_);
  topics_ = made;
  name_space_ = name_space;
}

RobotConnection RosRobot::connectionNow() const {
  RobotConnection now;
  now.name_space = fromRos(name_space_);
  const aibo_driver::Connection::ConstPtr message = topics_ ? topics_->connection() : nullptr;
  if (master_answers_ && topics_ && !message) {
    now.state = RobotConnection::State::kWaiting;
    now.text = "waiting for the driver in " + now.name_space + (topics_->areNew() ? "" : ": is it running?");
    return now;
  }
  if (!topics_ || !topics_->isHeard() || !message) {
    now.state = master_answers_ ? RobotConnection::State::kNoDriver : RobotConnection::State::kNoMaster;
    now.text = master_answers_ ? noDriverText(now.name_space) : noMasterText();
    return now;
  }
  now.state = toState(message->state);
  now.robot = fromRos(message->robot);
  now.address = fromRos(aibo_client::addressText(message->host, message->port));
  now.protocol_version = message->protocol_version;
  now.master_answers = master_answers_;
  now.text = fromRos(message->text) + (master_answers_ ? QString() : "; " + noMasterText());
  return now;
}

void RosRobot::reportConnection() {
  report(connectionNow());
}

void RosRobot::report(const RobotConnection& now) {
  const QString text = now.name_space + now.robot + now.text;
  if (text != std::exchange(reported_connection_, text)) {
    post([this, now](Robot& robot) {
      connection_ = now;
      Q_EMIT robot.connectionChanged(now);
    });
  }
}

// The functions below carry out the user's wishes.

void RosRobot::post(const std::function<void(Robot&)>& work) {
  QMetaObject::invokeMethod(
      this, [this, work] { work(*this); }, Qt::QueuedConnection);
}

void RosRobot::postFrom(const QString& driver, const std::function<void(Robot&)>& work) {
  post([this, driver, work](Robot& robot) {
    if (driver == connection_.name_space) {
      work(robot);
    }
  });
}

void RosRobot::answer(bool success, const QString& text) {
  post([success, text](Robot& robot) { Q_EMIT robot.answered(success, text); });
}

std::shared_ptr<DriverTopics> RosRobot::topics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return topics_;
}

std::shared_ptr<DriverTopics> RosRobot::topicsForCommand(const QString& request) {
  if (connection_.isConnected()) {
    return topics();
  }
  answer(false, request + ": " + connection_.text);
  return nullptr;
}

template <typename Service>
void RosRobot::call(const QString& request, const std::string& service, const typename Service::Request& arguments,
                    const std::function<void(const typename Service::Response&)>& also) {
  using Response = typename Service::Response;
  if (connection_.name_space.isEmpty()) {
    answer(false, request + ": " + connection_.text);
    return;
  }
  const std::string name = ros::names::resolve(connection_.name_space.toStdString(), service);
  const auto done = [this, request, name, also](const Response* response) {
    if (response == nullptr) {
      answer(false, request + ": " + noAnswerText(name));
    } else if constexpr (std::is_same_v<Service, dynamic_reconfigure::Reconfigure>) {
      also(*response);
    } else {
      // An answer is shown only if the request failed, because it must not hide the answer to the user's own request.
      const bool success = response->success != 0;
      if (!std::is_same_v<Service, ListMotions> || !success) {
        answer(success, request + ": " + fromRos(response->message));
      }
      if (also && success) {
        also(*response);
      }
    }
  };
  if (!calls_.start<Service>(name, arguments, done)) {
    answer(false, request + ": the last call has not been answered yet");
  }
}

void RosRobot::useDriver(const QString& name_space) {
  std::string problem;
  if (!ros::names::validate(name_space.toStdString(), problem)) {
    answer(false, "driver: " + fromRos(problem));
    return;
  }
  wish([&name_space](Wishes& wishes) { wishes.name_space = name_space.toStdString(); });
}

void RosRobot::show(const std::set<Part>& parts) {
  wish([&parts](Wishes& wishes) { wishes.visible = parts; });
}

void RosRobot::stop() {
  const auto used = topics();
  if (!used) {
    answer(false, "stop: " + connection_.text);
    return;
  }
  node::StopClient& client = used->stopClient();
  client.stop([this, service = client.service()](const node::StopClient::Response* response) {
    answer(response != nullptr && response->success != 0,
           "stop: " + (response != nullptr ? fromRos(response->message) : noAnswerText(service)));
  });
}

void RosRobot::release() {
  call<std_srvs::Trigger>("release", "release", {});
}

void RosRobot::takePicture(const QString& folder) {
  const auto done = [this, folder](const TakePicture::Response& response) {
    try {
      const QString path = savePicture(response.image.data, folder);
      const QImage image = QImage::fromData(response.image.data.data(), static_cast<int>(response.image.data.size()));
      post([image, path](Robot& robot) { Q_EMIT robot.pictureTaken(image, path); });
    } catch (const std::runtime_error& error) {
      answer(false, QString("take picture: ") + error.what());
    }
  };
  call<TakePicture>("take picture", "take_picture", {}, done);
}

void RosRobot::setStreaming(bool on) {
  std_srvs::SetBool::Request request;
  request.data = static_cast<std::uint8_t>(on);
  call<std_srvs::SetBool>(on ? "stream on" : "stream off", "set_streaming", request);
}

void RosRobot::setMotors(bool on) {
  std_srvs::SetBool::Request request;
  request.data = static_cast<std::uint8_t>(on);
  call<std_srvs::SetBool>(on ? "motors on" : "motors off", "motors", request);
}

void RosRobot::takePosture(const QString& posture) {
  call<std_srvs::Trigger>(posture, posture.toStdString(), {});
}

void RosRobot::listMotions() {
  call<ListMotions>("list motions", "list_motions", {},
                    [this, driver = connection_.name_space](const ListMotions::Response& response) {
                      postFrom(driver,
                               [names = fromRos(response.names)](Robot& robot) { Q_EMIT robot.motionsListed(names); });
                    });
}

void RosRobot::playMotion(const QString& name, int repetitions) {
  PlayMotion::Request arguments;
  arguments.name = name.toStdString();
  arguments.repetitions = static_cast<std::uint16_t>(repetitions);
  call<PlayMotion>("play " + name, "play_motion", arguments);
}

void RosRobot::uploadMotion(const QString& name, const QByteArray& motion) {
  UploadMotion::Request arguments;
  arguments.name = name.toStdString();
  arguments.data.assign(motion.begin(), motion.end());
  call<UploadMotion>("upload " + name, "upload_motion", arguments,
                     [this, name, driver = connection_.name_space](const UploadMotion::Response&) {
                       postFrom(driver, [name](Robot& robot) { Q_EMIT robot.motionUploaded(name); });
                     });
}

void RosRobot::stopMotions() {
  call<StopMotion>("stop motions", "stop_motion", {});
}

void RosRobot::changeSetting(const QString& name, const QVariant& value) {
  const auto used = topics();
  const std::string settings = used ? used->settings() : "";
  if (settings.empty()) {
    answer(false, name + ": the driver has not said where its settings are");
    return;
  }
  dynamic_reconfigure::Reconfigure::Request request;
  request.config = changeOf(name, value);
  const auto done = [this, name,
                     driver = connection_.name_space](const dynamic_reconfigure::Reconfigure::Response& response) {
    const SettingValues values = valuesIn(response.config);
    postFrom(driver, [values](Robot& robot) { Q_EMIT robot.settingsChanged(values); });
    answer(true, name + " is " + values.value(name).toString());
  };
  call<dynamic_reconfigure::Reconfigure>(name, settings + "/set_parameters", request, done);
}

void RosRobot::setLeds(const QStringList& names, double intensity) {
  if (const auto topics = topicsForCommand("LEDs")) {
    topics->publishLeds(names, intensity);
  }
}

void RosRobot::flickEars(bool left, bool right) {
  if (const auto topics = topicsForCommand("ears")) {
    topics->publishEars(left, right);
  }
}

void RosRobot::moveJoints(const JointPositions& positions) {
  if (const auto topics = topicsForCommand("joints")) {
    topics->publishJoints(positions);
  }
}

void RosRobot::say(const QString& text) {
  Say::Request arguments;
  arguments.text = text.toStdString();
  call<Say>("say", "say", arguments);
}

void RosRobot::stopSound() {
  PlaySound::Request arguments;
  arguments.stop = 1;
  call<PlaySound>("stop sound", "play_sound", arguments);
}

// Sends a velocity, always also the one that ends a walk. A failure to send it is not reported.
void RosRobot::walk(double forward, double left, double turn) {
  const bool is_end = forward == 0 && left == 0 && turn == 0;
  if (const auto used = is_end ? topics() : topicsForCommand("walk")) {
    used->publishVelocity(forward, left, turn);
  }
}

void RosRobot::lookAt(const QPointF& place) {
  const auto topics = topicsForCommand("look there");
  if (topics && !topics->publishLookAt(place)) {
    answer(false, "look there: nothing is known of the camera yet");
  }
}

}  // namespace aibo_driver::remote_control
