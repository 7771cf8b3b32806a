#ifndef AIBO_RCSERVER_RCSERVER_INTERVAL_H
#define AIBO_RCSERVER_RCSERVER_INTERVAL_H

/// Chooses every n-th of numbered things: images by their count, or measurements by their frame. Numbers may have gaps,
/// and may overflow.
class Interval {
 public:
  /// @param length n; 1 chooses all, even if their number stays the same, and 0 chooses none
  explicit Interval(unsigned length = 0) : length_(length), has_chosen_(false), last_(0) {}

  /// Chooses the first one, and then each that is at least `length` after the last one.
  /// @return true if this one is chosen
  bool Chooses(unsigned number) {
    const bool is_due = length_ == 1 || !has_chosen_ || number - last_ >= length_;
    if (length_ == 0 || !is_due) {
      return false;
    }
    Replace(number);
    return true;
  }

  /// Chooses this one in place of the last one.
  void Replace(unsigned number) {
    has_chosen_ = true;
    last_ = number;
  }

 private:
  unsigned length_;
  bool has_chosen_;
  unsigned last_;  ///< the last one chosen
};

#endif  // AIBO_RCSERVER_RCSERVER_INTERVAL_H
