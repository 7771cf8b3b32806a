#include "remote_control/page.h"

#include <QCheckBox>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QProgressBar>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <chrono>
#include <utility>

namespace aibo_driver::remote_control {
namespace {

constexpr int kQuiet = -70;  // dB; a quiet room
constexpr int kLoud = -10;   // dB; samples may already be clipped
constexpr std::chrono::milliseconds kSilence{3000};
constexpr int kLongestText = 1000;  // characters; the service takes 4000 bytes
const QColor kLoudColor("#e53935");

class SoundPage : public Page {
 public:
  explicit SoundPage(Robot& robot, QWidget* parent);

  /// The robot's microphones are open only while the user wants it.
  std::optional<Part> part() const override {
    return listen_->isChecked() ? std::make_optional(Part::kMicrophones) : std::nullopt;
  }

 private:
  bool listens() const { return isVisible() && listen_->isChecked(); }
  QWidget* makeMicrophones();
  QWidget* makeSpeech();
  void showLevel(double level);
  void waitForSound();
  void showSilence();
  void connectionChanged(const RobotConnection& connection) override;
  void say();

  Robot& robot_;
  QCheckBox* listen_;
  QProgressBar* level_;
  QLineEdit* text_;
  bool had_robot_ = false;
  QTimer silence_;  ///< runs out when nothing has come for a while
};

SoundPage::SoundPage(Robot& robot, QWidget* parent)
    : Page(parent),
      robot_(robot),
      listen_(new QCheckBox("Listen", this)),
      level_(new QProgressBar(this)),
      text_(new QLineEdit(this)) {
  auto* layout = new QVBoxLayout(makeContent());
  layout->setContentsMargins(6, 4, 6, 4);
  layout->addWidget(makeMicrophones());
  layout->addWidget(makeSpeech());
  layout->addStretch(1);
  silence_.setSingleShot(true);
  silence_.setInterval(kSilence);
  connect(&silence_, &QTimer::timeout, this, &SoundPage::showSilence);
  connect(listen_, &QCheckBox::toggled, this, &Page::visibilityChanged);
  connect(this, &Page::visibilityChanged, this, &SoundPage::waitForSound);
  connect(&robot, &Robot::heard, this, &SoundPage::showLevel);
}

QWidget* SoundPage::makeMicrophones() {
  listen_->setObjectName("listen");
  listen_->setToolTip(
      "Opens the robot's microphones while this page is shown. They take up to 520 kbit/s of its link.");
  level_->setObjectName("level");
  level_->setRange(kQuiet, 0);
  level_->setValue(kQuiet);
  level_->setFormat("");
  level_->setToolTip("How loud it is. At 0 dB, it cannot be louder.");
  auto* group = new QGroupBox("Microphones", this);
  auto* row = new QHBoxLayout(group);
  row->setContentsMargins(4, 4, 4, 4);
  row->addWidget(need(Needs::kVersion2, listen_));
  row->addWidget(level_, 1);
  return group;
}

QWidget* SoundPage::makeSpeech() {
  text_->setObjectName("say_text");
  text_->setPlaceholderText("what the robot says");
  text_->setMaxLength(kLongestText);
  text_->setProperty(kTakesSpaces, true);
  text_->setToolTip(
      "What the robot says, in English. While you write here, the space bar writes spaces; the Escape key stops the "
      "robot.");
  auto* group = new QGroupBox("Speech", this);
  auto* row = new QHBoxLayout(group);
  row->setContentsMargins(4, 4, 4, 4);
  row->addWidget(need(Needs::kVersion2, text_), 1);
  row->addWidget(makeButton(Needs::kVersion2, "Say", "Speaks the text", [this] { say(); }));
  row->addWidget(makeButton(Needs::kVersion2, "Silence", "Ends the speech or other sound that plays",
                            [this] { robot_.stopSound(); }));
  connect(text_, &QLineEdit::returnPressed, this, &SoundPage::say);
  return group;
}

void SoundPage::say() {
  if (!text_->text().trimmed().isEmpty()) {
    robot_.say(text_->text().trimmed());
    text_->selectAll();
  }
}

void SoundPage::showLevel(double level) {
  if (!listens() || !hasRobot()) {
    return;  // it was on its way
  }
  silence_.start();
  level_->setFormat(QString("%1 dB").arg(qRound(level)));
  level_->setValue(std::clamp(qRound(level), kQuiet, 0));
  QPalette colors = palette();
  if (level > kLoud) {
    colors.setColor(QPalette::Highlight, kLoudColor);
  }
  if (colors != level_->palette()) {
    level_->setPalette(colors);
  }
}

// No sound can come while the page is hidden or there is no robot.
void SoundPage::waitForSound() {
  const bool waits = listens() && hasRobot();
  level_->setValue(kQuiet);
  level_->setFormat(waits ? "listening..." : "");
  waits ? silence_.start() : silence_.stop();
}

void SoundPage::connectionChanged(const RobotConnection& connection) {
  if (std::exchange(had_robot_, connection.hasRobot()) != connection.hasRobot()) {
    waitForSound();
  }
}

void SoundPage::showSilence() {
  level_->setValue(kQuiet);
  level_->setFormat("nothing comes: does the robot's RCSERVER.CFG say ALLOW_MICROPHONE=yes?");
}

}  // namespace

Page* makeSoundPage(Robot& robot, QWidget* parent) {
  return new SoundPage(robot, parent);
}

}  // namespace aibo_driver::remote_control
