#include "remote_control/connection_bar.h"

#include <QGridLayout>
#include <QSignalBlocker>
#include <cmath>
#include <utility>

#include "remote_control/widgets.h"

namespace aibo_driver::remote_control {
namespace {

QString colourOf(const RobotConnection& connection) {
  switch (connection.state) {
    case RobotConnection::State::kConnected:
      return connection.master_answers ? "#4caf50" : "#ffb300";
    case RobotConnection::State::kConnecting:
    case RobotConnection::State::kWaiting:
      return "#ffb300";
    case RobotConnection::State::kPlayback:
      return "#1e88e5";
    case RobotConnection::State::kDisconnected:
    case RobotConnection::State::kNoDriver:
    case RobotConnection::State::kNoMaster:
      break;
  }
  return "#e53935";
}

QString titleOf(const RobotConnection& connection) {
  if (!connection.isConnected()) {
    return connection.text;
  }
  const QString robot = connection.robot.isEmpty() ? QString("robot") : connection.robot;
  return robot + " at " + connection.address + ", connected (version " + QString::number(connection.protocol_version) +
         ")" + (connection.master_answers ? "" : "; the ROS master does not answer");
}

}  // namespace

ConnectionBar::ConnectionBar(QWidget* parent)
    : QWidget(parent),
      chooser_(new QComboBox(this)),
      lamp_(new QLabel(QString::fromUtf8("\u25CF"), this)),
      text_(new ElidedLabel(this)),
      battery_(new QLabel(this)),
      link_(new ElidedLabel(this)) {
  chooser_->setObjectName("driver");
  chooser_->setToolTip("The drivers that are running, by namespace");
  constexpr int kShownLength = 10;  // in characters; the list shows long names in full
  chooser_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  chooser_->setMinimumContentsLength(kShownLength);
  new IgnoreWheel(chooser_);
  lamp_->setObjectName("lamp");
  text_->setObjectName("connection");
  battery_->setObjectName("battery");
  link_->setObjectName("link");
  link_->setAlignment(Qt::AlignRight);
  battery_->setFixedWidth(fontMetrics().horizontalAdvance("Battery 100 %, 25 \u00B0C "));
  link_->setToolTip("Pictures a second; how old they are when they are published; the share that did not arrive");
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->addWidget(lamp_, 0, 0);
  grid->addWidget(text_, 0, 1, 1, 2);
  grid->addWidget(chooser_, 0, 3);
  grid->addWidget(battery_, 1, 1);
  grid->addWidget(link_, 1, 2, 1, 2);
  grid->setColumnStretch(2, 1);
  connect(chooser_, qOverload<int>(&QComboBox::activated), this,
          [this](int index) { Q_EMIT chosen(chooser_->itemText(index)); });
  showConnection({});
}

void ConnectionBar::showDrivers(const QStringList& name_spaces) {
  found_ = name_spaces;
  fillChooser();
}

void ConnectionBar::showConnection(const RobotConnection& connection) {
  const bool is_other = connection.name_space != std::exchange(current_, connection.name_space);
  fillChooser();
  lamp_->setStyleSheet("color: " + colourOf(connection));
  text_->showText(titleOf(connection));
  if (is_other) {
    battery_->clear();
  }
  battery_->setEnabled(connection.hasRobot());  // without a robot: the last charge, which may say why it is gone
  if (!connection.hasRobot()) {
    link_->clear();
  }
}

// The list contains the driver in use, even if it does not run.
void ConnectionBar::fillChooser() {
  QStringList entries = found_;
  if (!current_.isEmpty() && !entries.contains(current_)) {
    entries.prepend(current_);
  }
  if (entries != std::exchange(entries_, entries)) {  // unchanged entries stay, because somebody may be choosing
    chooser_->clear();
    chooser_->addItems(entries);
  }
  chooser_->setCurrentText(current_);
  chooser_->setEnabled(!entries.empty());
}

void ConnectionBar::showBattery(double charge, double temperature) {
  QStringList parts;
  if (std::isfinite(charge)) {
    parts.append(QString("Battery %1 %").arg(qRound(100 * charge)));
  }
  if (std::isfinite(temperature)) {
    parts.append(QString::fromUtf8("%1 \u00B0C").arg(qRound(temperature)));
  }
  battery_->setText(parts.join(", "));
  battery_->setStyleSheet(charge < 0.2 ? "color: #e53935; font-weight: bold" : "");
}

void ConnectionBar::showLink(const LinkFigures& figures) {
  QString text = QString("%1 pictures/s").arg(figures.pictures_per_second, 0, 'f', 1);
  if (std::isfinite(figures.age)) {
    text += QString(", %1 ms old").arg(qRound(1000 * figures.age));
  }
  if (std::isfinite(figures.lost)) {
    text += QString(", %1 % lost").arg(100 * figures.lost, 0, 'f', figures.lost > 0 ? 1 : 0);
  }
  link_->setText(text);
}

}  // namespace aibo_driver::remote_control
