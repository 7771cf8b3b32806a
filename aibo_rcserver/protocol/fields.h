/// Encodes and decodes the payloads of version 2. Each payload is a struct with a member
///
///     template <typename Fields> void visit(Fields& fields)
///
/// which names its fields in the order of the wire, with the requirements of the layout. encode(), decode() and
/// encodedSize() all follow from it. This file is C++98, does no I/O and allocates no memory.
#ifndef AIBO_RCSERVER_PROTOCOL_FIELDS_H
#define AIBO_RCSERVER_PROTOCOL_FIELDS_H

#include <stddef.h>
#include <string.h>

#include "protocol/big_endian.h"
#include "protocol/text.h"

namespace protocol {
namespace version2 {

/// Reads a file's name: readMotionName() or readPictureName().
typedef const char* (*ReadFileName)(const char* text, size_t size, FileName& name);

/// Encodes the fields of a payload. The values must be ones that a Reader accepts. The comments of Reader describe each
/// kind of field.
class Writer {
 public:
  /// @param out room for all bytes; NULL to count the bytes only
  explicit Writer(unsigned char* out) : out_(out), size_(0) {}

  /// The number of bytes so far.
  size_t size() const { return size_; }

  void number(char value) { put(&value, 1); }
  void number(unsigned char value) { put(&value, 1); }
  void number(unsigned short value) {
    unsigned char bytes[2];
    encodeBigEndian16(value, bytes);
    put(bytes, sizeof(bytes));
  }
  void number(short value) { number(static_cast<unsigned short>(value)); }
  void number(unsigned value) {
    unsigned char bytes[4];
    encodeBigEndian32(value, bytes);
    put(bytes, sizeof(bytes));
  }
  void number(int value) { number(static_cast<unsigned>(value)); }
  void thousandths(double value) {
    number(static_cast<short>(static_cast<int>(value * 1000 + (value < 0 ? -0.5 : 0.5))));
  }
  void zeros(size_t count) { put("\0\0\0", count); }
  void flag(bool value, const char* /*problem*/) { number(static_cast<unsigned char>(value ? 1 : 0)); }
  template <typename Choice>
  void choice(Choice value, int /*last*/, const char* /*problem*/) {
    number(static_cast<unsigned char>(value));
  }
  template <typename Value>
  void packed(const Value& value, unsigned short (*pack)(const Value&), const char* (*)(unsigned short, Value*)) {
    number(pack(value));
  }

  template <typename Item>
  void item(Item& value) {
    value.visit(*this);
  }
  void item(unsigned char value) { number(value); }
  template <typename Item, typename Count>
  void list(Item* items, Count count, size_t /*most*/, const char* /*problem*/) {
    for (size_t i = 0; i < count; ++i) {
      item(items[i]);
    }
  }
  template <typename Item, typename Count>
  void rest(Item* items, Count count, size_t most, const char* problem) {
    list(items, count, most, problem);
  }
  template <typename Item>
  void once(const Item* /*items*/, size_t /*count*/, const char* /*problem*/) {}

  void text(const char* text, size_t size, size_t limit) { put(text, sizeOfWholeCharacters(text, size, limit)); }
  void line(const char* line, size_t size, size_t limit, const char* /*problem*/) {
    text(line, size, limit);
    number('\n');
  }
  void content(const unsigned char* bytes, size_t size) { put(bytes, size); }
  void name(ReadFileName /*read*/, const FileName& name, bool /*may_be_empty*/) { put(name, strlen(name)); }
  void sizedName(ReadFileName read, const FileName& name, const char* /*problem*/) {
    number(static_cast<unsigned char>(strlen(name)));
    this->name(read, name, false);
  }

  void require(bool /*good*/, const char* /*problem*/) {}

 private:
  void put(const void* bytes, size_t size) {
    // A text or content may be empty and have no address, but memcpy() forbids a null pointer.
    if (out_ != NULL && size > 0) {
      memcpy(out_ + size_, bytes, size);
    }
    size_ += size;
  }

  unsigned char* const out_;
  size_t size_;
};

/// Decodes the fields of a payload. A wrong size is reported before a wrong value. Missing bytes count as 0.
class Reader {
 public:
  Reader(const unsigned char* bytes, size_t size)
      : next_(bytes),
        end_(bytes + size),
        problem_(NULL),
        wrong_size_("the payload has a wrong size for this kind of frame"),
        is_short_(false) {}

  /// What is wrong so far, in words that can follow "bad request: "; NULL if nothing is wrong.
  const char* problem() const { return is_short_ ? wrong_size_ : problem_; }
  /// Does the same after the last field, where bytes that are left are wrong, too.
  const char* problemAtEnd() const { return next_ == end_ ? problem() : wrong_size_; }
  size_t left() const { return static_cast<size_t>(end_ - next_); }

  void number(char& value) { value = static_cast<char>(*take(1)); }
  void number(unsigned char& value) { value = *take(1); }
  void number(unsigned short& value) { value = decodeBigEndian16(take(2)); }
  void number(short& value) { value = decodeBigEndianSigned16(take(2)); }
  void number(unsigned& value) { value = decodeBigEndian32(take(4)); }
  void number(int& value) { value = decodeBigEndianSigned32(take(4)); }

  /// An int16 in thousandths, rounded to the nearest.
  void thousandths(double& value) {
    short number_of_them = 0;
    number(number_of_them);
    value = number_of_them * 1e-3;
  }

  /// Reserved bytes, at most three.
  void zeros(size_t count) { require(memcmp(take(count), "\0\0\0", count) == 0, "a reserved byte is not 0"); }

  /// A byte that is 0 or 1.
  void flag(bool& value, const char* problem) { choice(value, 1, problem); }

  /// A byte that is an enumerator, from 0 to `last`.
  template <typename Choice>
  void choice(Choice& value, int last, const char* problem) {
    const unsigned char byte = *take(1);
    require(byte <= last, problem);
    value = static_cast<Choice>(byte <= last ? byte : 0);
  }

  /// A uint16 that is stored as another type.
  template <typename Value>
  void packed(Value& value, unsigned short (*)(const Value&), const char* (*unpack)(unsigned short, Value*)) {
    const char* const problem = unpack(decodeBigEndian16(take(2)), &value);
    require(problem == NULL, problem);
  }

  /// A byte, or a struct with fields of its own.
  template <typename Item>
  void item(Item& value) {
    value.visit(*this);
  }
  void item(unsigned char& value) { number(value); }

  /// Items, after a field with their number.
  /// @param problem the report if there are more than `most`
  template <typename Item, typename Count>
  void list(Item* items, Count& count, size_t most, const char* problem) {
    wrong_size_ = "the count does not match the size of the payload";
    const size_t announced = count;
    if (announced > most) {
      stop(problem);
    }
    for (count = 0; count < announced && left() > 0; ++count) {
      item(items[count]);
    }
    is_short_ = is_short_ || (count < announced && announced <= most);
  }

  /// Items up to the end of the payload.
  template <typename Item, typename Count>
  void rest(Item* items, Count& count, size_t most, const char* problem) {
    for (count = 0; count < most && left() > 0; ++count) {
      item(items[count]);
    }
    if (left() > 0) {
      stop(problem);
    }
  }

  /// Requires that all items have different ids.
  template <typename Item>
  void once(const Item* items, size_t count, const char* problem) {
    for (size_t i = 1; i < count; ++i) {
      for (size_t j = 0; j < i; ++j) {
        require(idOf(items[i]) != idOf(items[j]), problem);
      }
    }
  }

  /// Plain text (text.h) up to the end of the payload. The result points into the payload.
  /// @param limit the size to which a Writer cuts the text, after a whole character
  void text(const char*& text, size_t& size, size_t /*limit*/) { takeText(left(), text, size); }

  /// Plain text up to a newline, which is required.
  void line(const char*& line, size_t& size, size_t /*limit*/, const char* problem) {
    const void* const newline = left() == 0 ? NULL : memchr(next_, '\n', left());
    takeText(newline == NULL ? left() : static_cast<size_t>(static_cast<const unsigned char*>(newline) - next_), line,
             size);
    require(newline != NULL, problem);
    next_ += newline == NULL ? 0 : 1;
  }

  /// Any bytes up to the end of the payload. The result points into the payload.
  void content(const unsigned char*& bytes, size_t& size) {
    size = left();
    bytes = next_;
    next_ = end_;
  }

  /// A file's name, up to the end of the payload.
  void name(ReadFileName read, FileName& name, bool may_be_empty) { takeName(read, left(), name, may_be_empty); }

  /// A file's name after a byte with its size.
  /// @param problem the report if the name is longer than the payload
  void sizedName(ReadFileName read, FileName& name, const char* problem) {
    const size_t size = left() == 0 ? 1 : *take(1);
    if (size > left()) {
      stop(problem);
    }
    takeName(read, size > left() ? 0 : size, name, false);
  }

  /// Requires that `good` is true. Call this after the fields that it concerns.
  void require(bool good, const char* problem) { problem_ = problem_ == NULL && !good ? problem : problem_; }

 private:
  static unsigned char idOf(unsigned char id) { return id; }
  template <typename Item>
  static unsigned char idOf(const Item& item) {
    return item.id;
  }

  // Gives up on the rest of the payload.
  void stop(const char* problem) {
    require(false, problem);
    next_ = end_;
  }

  // The next bytes; zeros (at most four) if there are too few.
  const unsigned char* take(size_t size) {
    static const unsigned char ZEROS[4] = {0, 0, 0, 0};
    const bool is_there = size <= left();
    const unsigned char* const bytes = is_there ? next_ : ZEROS;
    is_short_ = is_short_ || !is_there;
    next_ = is_there ? next_ + size : end_;
    return bytes;
  }

  void takeText(size_t size, const char*& text, size_t& text_size) {
    text = reinterpret_cast<const char*>(next_);
    text_size = size;
    require(isPlainText(text, size), "the text is not plain: not UTF-8, or with control characters");
    next_ += size;
  }

  void takeName(ReadFileName read, size_t size, FileName& name, bool may_be_empty) {
    name[0] = '\0';
    if (size > 0 || !may_be_empty) {
      const char* const problem = read(reinterpret_cast<const char*>(next_), size, name);
      require(problem == NULL, problem);
      next_ += size;
    }
  }

  const unsigned char* next_;
  const unsigned char* const end_;
  const char* problem_;
  const char* wrong_size_;
  bool is_short_;
};

/// @param out room for encodedSize() bytes; NULL to count the bytes only
/// @return number of bytes
template <typename Payload>
size_t encode(const Payload& payload, unsigned char* out) {
  Writer writer(out);
  const_cast<Payload&>(payload).visit(writer);
  return writer.size();
}

template <typename Payload>
size_t encodedSize(const Payload& payload) {
  return encode(payload, NULL);
}

/// Decodes a payload and checks its size, counts, reserved bytes and limited values. It is left to the server to check
/// whether a value makes sense for this robot, for instance whether a joint exists.
/// @param[out] payload undefined unless the result is NULL
/// @return NULL, or what is wrong, in words that can follow "bad request: "
template <typename Payload>
const char* decode(const unsigned char* bytes, size_t size, Payload* payload) {
  Reader reader(bytes, size);
  payload->visit(reader);
  return reader.problemAtEnd();
}

}  // namespace version2
}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_FIELDS_H
