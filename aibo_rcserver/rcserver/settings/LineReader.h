/// @file LineReader.h
/// Lines of a configuration file.
#ifndef AIBO_RCSERVER_RCSERVER_SETTINGS_LINE_READER_H
#define AIBO_RCSERVER_RCSERVER_SETTINGS_LINE_READER_H

#include <stddef.h>
#include <stdio.h>

/// Reads a file line by line: in capitals, without what comes behind a #, without spaces at either end, and however
/// lines end on the system that the file was written on. Memory of a fixed size.
class LineReader {
 public:
  /// Longest line, without comment and end.
  static const size_t MAX_LINE_SIZE = 1023;

  /// @param file must outlive this
  explicit LineReader(FILE* file) : file_(file), number_(0), size_(0), is_text_(true) { line_[0] = '\0'; }

  /// Goes on to the next line; it may be empty.
  /// @return false at the end of the file
  bool Next();

  /// From 1.
  int Number() const { return number_; }

  /// False if the line is too long or has a zero byte in it; Line() is of no use then.
  bool IsText() const { return is_text_; }

  const char* Line() const { return line_; }

 private:
  LineReader(const LineReader&);
  LineReader& operator=(const LineReader&);

  void Add(int character);
  void Trim();

  FILE* file_;
  int number_;
  size_t size_;
  bool is_text_;
  char line_[MAX_LINE_SIZE + 1];
};

#endif  // AIBO_RCSERVER_RCSERVER_SETTINGS_LINE_READER_H
