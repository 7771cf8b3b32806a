/// @file RCRegion.h
#ifndef OPENR_RCREGION_H
#define OPENR_RCREGION_H

#include <OPENR/OPENR.h>

/// Memory that counts its references, so that several objects can read it without copying. A region begins with its
/// creator's reference, and is deleted with the last one. When NumberOfReference() is 1, all observers are done, and
/// the creator may fill it again.
class RCRegion {
 public:
  /// Makes a region of zeros, aligned for any type.
  explicit RCRegion(size_t size);

  /// Refers to memory that must outlive the region.
  /// @param memID, offset the system's name for the memory; only stored for the caller
  RCRegion(MemoryRegionID memID, size_t offset, void* base, size_t size);

  /// Call this to keep a region longer than the event that delivered it.
  void AddReference();

  /// Removes a reference. The last call deletes the region.
  void RemoveReference();

  int NumberOfReference() const { return references_; }

  char* Base() const { return base_; }
  size_t Size() const { return size_; }
  MemoryRegionID MemID() const { return memory_id_; }
  size_t Offset() const { return offset_; }

 private:
  ~RCRegion();
  RCRegion(const RCRegion&);
  RCRegion& operator=(const RCRegion&);

  MemoryRegionID memory_id_;
  size_t offset_;
  char* base_;
  size_t size_;
  bool owns_memory_;
  int references_;
};

#endif  // OPENR_RCREGION_H
