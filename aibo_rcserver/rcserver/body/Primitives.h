/// @file Primitives.h
/// Primitives of OPEN-R that have been opened.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_PRIMITIVES_H
#define AIBO_RCSERVER_RCSERVER_BODY_PRIMITIVES_H

#include <OPENR/OPENR.h>

/// Opens the primitives of a table and finds them again.
class Primitives {
 public:
  /// Most rows of a table.
  static const int MAX_ROWS = 32;

  /// What Find() returns when there is none.
  static const int NOT_OPEN = -1;

  Primitives();

  /// Opens one; if it does not open, the log says so.
  /// @param row in the table, 0..MAX_ROWS - 1
  /// @param name for the log
  bool Open(int row, const char* name, const char* locator);

  /// Closes all.
  void Close();

  bool IsOpen(int row) const { return ids_[row] != oprimitiveID_UNDEF; }
  OPrimitiveID Id(int row) const { return ids_[row]; }

  /// The row of an open primitive.
  int Find(OPrimitiveID id) const;

 private:
  OPrimitiveID ids_[MAX_ROWS];
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_PRIMITIVES_H
