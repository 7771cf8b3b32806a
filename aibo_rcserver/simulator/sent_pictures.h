/// @file sent_pictures.h
#ifndef AIBO_RCSERVER_SIMULATOR_SENT_PICTURES_H
#define AIBO_RCSERVER_SIMULATOR_SENT_PICTURES_H

#include <cstddef>
#include <string>

/// Finds the pictures in the data that an RCServer gives to the IPStack. A large picture comes in parts, which follow
/// each other in memory.
class SentPictures {
 public:
  /// Adds the bytes of the next send.
  /// @return true if they begin a picture, in either version of the protocol, by TCP or UDP
  bool add(const void* data, std::size_t size);

  /// True if the last add() completed a picture.
  bool isComplete() const { return !is_parity_ && jpeg_size_ > 0 && jpeg_.size() == jpeg_size_; }

  /// The JPEG; only if isComplete().
  const std::string& jpeg() const { return jpeg_; }

 private:
  bool begin(const unsigned char* bytes, std::size_t size);
  bool addDatagram(const unsigned char* bytes, std::size_t size);

  std::string jpeg_;                     ///< the part received so far
  bool is_parity_ = false;               ///< the last one added: it has nothing of the JPEG that is not in its parts
  std::size_t jpeg_size_ = 0;            ///< of the complete picture; 0 if none is being sent
  const unsigned char* next_ = nullptr;  ///< beginning of its next part
};

#endif  // AIBO_RCSERVER_SIMULATOR_SENT_PICTURES_H
