/// @file OList.h
#ifndef OPENR_OLIST_H
#define OPENR_OLIST_H

#include <MCOOP.h>  // objects may rely on this include
#include <OPENR/ODebug.h>

typedef int OTLStatus;
const OTLStatus otlSUCCESS = 0;
const OTLStatus otlFAIL = 3;
const OTLStatus otlOVERFLOW = 1;   ///< the list is full
const OTLStatus otlUNDERFLOW = 2;  ///< the list is empty

/// A list with room for a fixed number of items.
/// @tparam MaxSize at least 1
template <class T, int MaxSize>
class OList {
 public:
  OList() : size_(0) {}

  /// @return otlOVERFLOW if the list is full
  OTLStatus PushBack(const T& item) {
    if (size_ == MaxSize) {
      return otlOVERFLOW;
    }
    At(size_++) = item;
    return otlSUCCESS;
  }
  /// @return otlUNDERFLOW if the list is empty
  OTLStatus PopBack() {
    if (size_ == 0) {
      return otlUNDERFLOW;
    }
    --size_;
    return otlSUCCESS;
  }

  /// Not for an empty list.
  T& Front() { return At(0); }
  T& Back() { return At(size_ - 1); }

  void Clear() { size_ = 0; }
  int GetSize() const { return size_; }

  /// Any change to the list invalidates the iterator.
  class Iterator {
   public:
    Iterator() : list_(0), index_(0) {}
    Iterator(OList* list, int index) : list_(list), index_(index) {}

    T& operator*() const { return list_->At(index_); }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    Iterator& operator--() {
      --index_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return list_ == other.list_ && index_ == other.index_; }
    bool operator!=(const Iterator& other) const { return !(*this == other); }

   private:
    OList* list_;
    int index_;
  };
  Iterator Begin() { return Iterator(this, 0); }
  /// Past the last item.
  Iterator End() { return Iterator(this, size_); }

 private:
  T& At(int index) { return items_[index]; }

  T items_[MaxSize];
  int size_;
};

#endif  // OPENR_OLIST_H
