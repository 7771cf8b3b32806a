#include <ros/this_node.h>
#include <rviz/panel.h>

#include <pluginlib/class_list_macros.hpp>

#include <QGuiApplication>
#include <QScreen>
#include <QTimer>
#include <QVBoxLayout>

#include "remote_control/remote_control.h"
#include "remote_control/ros_robot.h"

namespace aibo_driver::remote_control {
namespace {

constexpr const char* kNamespace = "Driver";
constexpr const char* kFolder = "Picture Folder";

}  // namespace

/// The window as a panel of rviz: aibo_driver/RemoteControl. rviz's configuration keeps the driver's namespace and the
/// folder for pictures.
class Panel : public rviz::Panel {
  Q_OBJECT

 public:
  explicit Panel(QWidget* parent = nullptr);
  ~Panel() override;

  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  RosRobot robot_;
  RemoteControl* window_;
};

Panel::Panel(QWidget* parent) : rviz::Panel(parent), window_(new RemoteControl(robot_, this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(window_);
  connect(window_, &RemoteControl::changed, this, &rviz::Panel::configChanged);
}

// Deletes the window, which uses the robot until its end. ~QWidget would do this too late, when the robot no longer
// exists.
Panel::~Panel() {
  delete window_;
}

// Limits the size, because rviz opens with the size in its configuration even if the screen is smaller.
void Panel::onInitialize() {
  QTimer::singleShot(0, this, [this] {
    const QSize decoration = window()->frameGeometry().size() - window()->size();
    const QSize room = QGuiApplication::primaryScreen()->availableSize() - decoration;
    if (!window()->isMaximized() && window()->size() != window()->size().boundedTo(room)) {
      window()->resize(window()->size().boundedTo(room));
      window()->move(QGuiApplication::primaryScreen()->availableGeometry().topLeft());
    }
  });
}

void Panel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  const QString name_space = QString::fromStdString(ros::this_node::getNamespace());  // rviz' namespace
  QString text = name_space == "/" ? "" : name_space;
  config.mapGetString(kNamespace, &text);
  window_->useDriver(text);
  if (config.mapGetString(kFolder, &text)) {
    window_->setFolder(text);
  }
}

void Panel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue(kNamespace, window_->driver());
  config.mapSetValue(kFolder, window_->folder());
}

}  // namespace aibo_driver::remote_control

PLUGINLIB_EXPORT_CLASS(aibo_driver::remote_control::Panel, rviz::Panel)

#include "panel.moc"
