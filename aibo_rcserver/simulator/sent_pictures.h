/// @file sent_pictures.h
#ifndef AIBO_RCSERVER_SIMULATOR_SENT_PICTURES_H
#define AIBO_RCSERVER_SIMULATOR_SENT_PICTURES_H

#include <cstddef>
#include <optional>
#include <string>

/// Finds pictures in the data that RCServer gives to the IPStack. The parts of a large picture follow each other in
/// memory.
class SentPictures {
 public:
  /// Adds the bytes of the next send.
  /// @return true if they begin a picture, in either version, by TCP or UDP
  bool add(const void* data, std::size_t size);

  bool isComplete() const { return !is_redundant_ && jpeg_size_ > 0 && jpeg_.size() == jpeg_size_; }

  /// Only if isComplete().
  const std::string& jpeg() const { return jpeg_; }

 private:
  bool begin(const unsigned char* bytes, std::size_t size);
  bool addDatagram(const unsigned char* bytes, std::size_t size);

  std::string jpeg_;                     ///< the part received so far
  bool is_redundant_ = false;            ///< the last datagram was a parity, or has been sent before
  std::size_t jpeg_size_ = 0;            ///< the complete picture's size; 0 if none is being sent
  const unsigned char* next_ = nullptr;  ///< where the next part begins
  unsigned picture_ = 0;                 ///< of the last part that came in a datagram
  std::optional<unsigned> next_sequence_;
};

#endif  // AIBO_RCSERVER_SIMULATOR_SENT_PICTURES_H
