#include "remote_control/widgets.h"

#include <QApplication>
#include <QFileDialog>
#include <QHelpEvent>
#include <QPainter>
#include <QTextDocument>
#include <QToolTip>

namespace aibo_driver::remote_control {

ElidedLabel::ElidedLabel(QWidget* parent, Qt::TextElideMode dots) : QLabel(parent), dots_(dots) {
  QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  policy.setRetainSizeWhenHidden(true);
  setSizePolicy(policy);
  setFixedHeight(fontMetrics().lineSpacing() + 2);
}

void ElidedLabel::showText(const QString& text) {
  setText(text);
  setToolTip(text);
}

void ElidedLabel::paintEvent(QPaintEvent*) {
  QPainter(this).drawText(rect(), alignment(), fontMetrics().elidedText(text(), dots_, width()));
}

bool IgnoreWheel::eventFilter(QObject*, QEvent* event) {
  const bool is_wheel = event->type() == QEvent::Wheel;
  if (is_wheel) {
    event->ignore();  // then the page gets it
  }
  return is_wheel;
}

PlainText::PlainText(QWidget* window) : QObject(window) {
  QCoreApplication::instance()->installEventFilter(this);
}

// A label is polished before it lays out its text. Tooltips are labels, too, but one may still belong to another window
// that has shown its own tooltip. So if a text looks like HTML, the tooltip gets it in a form that does not.
bool PlainText::eventFilter(QObject* watched, QEvent* event) {
  if ((event->type() != QEvent::Polish && event->type() != QEvent::ToolTip) || !isInWindow(watched)) {
    return false;
  }
  auto* const widget = qobject_cast<QWidget*>(watched);
  if (event->type() == QEvent::Polish) {
    if (auto* label = qobject_cast<QLabel*>(watched)) {
      label->setTextFormat(Qt::PlainText);
    }
    return false;
  }
  if (qobject_cast<QFileDialog*>(widget->window()) != nullptr) {
    return true;  // otherwise the tooltip would show the names of folders as HTML
  }
  if (!Qt::mightBeRichText(widget->toolTip())) {
    return false;
  }
  const QChar kNothing(0x200B);  // a space of no width
  const QString text =
      QString(widget->toolTip()).replace('<', QString("<") + kNothing).replace('&', QString("&") + kNothing);
  QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text, widget);
  return true;
}

bool PlainText::isInWindow(const QObject* object) const {
  while (object != nullptr && object != parent()) {
    object = object->parent();
  }
  return object != nullptr;
}

}  // namespace aibo_driver::remote_control
