#ifndef AIBO_RCSERVER_RCSERVER_QUEUE_H
#define AIBO_RCSERVER_RCSERVER_QUEUE_H

/// Items in the order in which they were added. Its memory has a fixed size: if it is full, a new item replaces the
/// oldest one.
template <typename Item, int CAPACITY>
class Queue {
 public:
  Queue() : oldest_(0), size_(0) {}

  int Size() const { return size_; }
  bool IsEmpty() const { return size_ == 0; }
  bool IsFull() const { return size_ == CAPACITY; }

  /// @param i 0 for the oldest item, Size() - 1 for the newest one
  const Item& At(int i) const { return items_[(oldest_ + i) % CAPACITY]; }

  void Add(const Item& item) {
    if (IsFull()) {
      DropOldest();
    }
    items_[(oldest_ + size_) % CAPACITY] = item;
    ++size_;
  }

  /// Takes the oldest item out.
  /// @return false if the queue is empty
  bool Take(Item* item) {
    if (IsEmpty()) {
      return false;
    }
    *item = At(0);
    DropOldest();
    return true;
  }

  void Clear() { size_ = 0; }

 private:
  void DropOldest() {
    oldest_ = (oldest_ + 1) % CAPACITY;
    --size_;
  }

  Item items_[CAPACITY];
  int oldest_;
  int size_;
};

#endif  // AIBO_RCSERVER_RCSERVER_QUEUE_H
