#ifndef AIBO_RCSERVER_RCSERVER_BODY_VECTOR_PAIR_H
#define AIBO_RCSERVER_RCSERVER_BODY_VECTOR_PAIR_H

#include <OPENR/OPENR.h>
#include <OPENR/OSubject.h>
#include <OPENR/RCRegion.h>
#include <stddef.h>

/// Two vectors that take turns at a gate: one is filled while the other is output. Output begins with both vectors, and
/// each READY is answered with one more. So a vector always waits while another is output, and the answer to READY may
/// take as long as a vector lasts (Level2 Reference Guide, page 44; the samples of the SDK do the same).
class VectorPair {
 public:
  static const int SIZE = 2;

  /// Returns a vector to OPEN-R, as OPENR::DeleteCommandVectorData() does.
  typedef OStatus (*Delete)(MemoryRegionID memory);

  explicit VectorPair(Delete delete_vector)
      : delete_(delete_vector), gate_(NULL), vectors_on_their_way_(0), has_sent_(false) {
    for (int i = 0; i < SIZE; ++i) {
      regions_[i] = NULL;
    }
  }

  ~VectorPair() {
    for (int i = 0; i < SIZE; ++i) {
      if (HasVector(i)) {
        regions_[i]->RemoveReference();
        delete_(memories_[i]);
      }
    }
  }

  /// @param gate to the object that outputs the vectors
  void Start(OSubject* gate) { gate_ = gate; }

  /// Takes over a vector that OPEN-R has created.
  /// @param number 0..SIZE - 1
  template <typename Vector>
  void Own(int number, MemoryRegionID memory, Vector* vector) {
    memories_[number] = memory;
    regions_[number] =
        new RCRegion(vector->vectorInfo.memRegionID, vector->vectorInfo.offset, vector, vector->vectorInfo.totalSize);
  }
  bool HasVector(int number) const { return regions_[number] != NULL; }

  /// False if CONNECT.CFG connects the gate to nothing.
  bool IsConnected() const { return vectors_on_their_way_ > 0 || gate_->IsReady(); }

  /// The number of vectors that were sent and whose output is not complete.
  int VectorsOnTheirWay() const { return vectors_on_their_way_; }

  /// The vector that is to be filled next.
  /// @return NULL if none is due
  RCRegion* Next() const {
    for (int i = 0; i < SIZE && vectors_on_their_way_ < SIZE && gate_->IsReady(); ++i) {
      if (HasVector(i) && regions_[i]->NumberOfReference() == 1) {
        return regions_[i];
      }
    }
    return NULL;
  }

  /// Sends a vector with the next Notify().
  /// @param vector from Next()
  void Send(RCRegion* vector) {
    gate_->SetData(vector);
    ++vectors_on_their_way_;
    has_sent_ = true;
  }

  /// Call this after one or more calls of Send().
  void Notify() {
    if (has_sent_) {
      has_sent_ = false;
      gate_->NotifyObservers();
    }
  }

  /// Call this on READY. No vector precedes the first READY.
  /// @return true if the output of the oldest vector is complete
  bool IsReady() {
    const bool is_complete = vectors_on_their_way_ > 0;
    vectors_on_their_way_ -= is_complete ? 1 : 0;
    return is_complete;
  }

 private:
  VectorPair(const VectorPair&);
  VectorPair& operator=(const VectorPair&);

  const Delete delete_;
  OSubject* gate_;
  MemoryRegionID memories_[SIZE];
  RCRegion* regions_[SIZE];
  int vectors_on_their_way_;
  bool has_sent_;  ///< a vector was sent since the last Notify()
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_VECTOR_PAIR_H
