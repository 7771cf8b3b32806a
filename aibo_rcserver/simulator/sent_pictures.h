/// @file sent_pictures.h
#ifndef AIBO_RCSERVER_SIMULATOR_SENT_PICTURES_H
#define AIBO_RCSERVER_SIMULATOR_SENT_PICTURES_H

#include <cstddef>
#include <string>

/// Finds the pictures in what an RCServer gives to the IPStack. A large one is given in parts, which follow one another
/// in memory.
class SentPictures {
 public:
  /// Takes the bytes of the next send.
  /// @return true if they begin a picture, in either version of the protocol
  bool add(const void* data, std::size_t size);

  /// True if the bytes of the last add() were the last ones of a picture.
  bool isComplete() const { return jpeg_size_ > 0 && jpeg_.size() == jpeg_size_; }

  /// The JPEG; only if isComplete().
  const std::string& jpeg() const { return jpeg_; }

 private:
  bool begin(const unsigned char* bytes, std::size_t size);

  std::string jpeg_;                     ///< what there is of it
  std::size_t jpeg_size_ = 0;            ///< of the whole of it; 0: no picture is being sent
  const unsigned char* next_ = nullptr;  ///< where its next part begins
};

#endif  // AIBO_RCSERVER_SIMULATOR_SENT_PICTURES_H
