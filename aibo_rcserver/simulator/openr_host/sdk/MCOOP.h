/// @file MCOOP.h
/// Memory of the robot's operating system.
#ifndef OPENR_MCOOP_H
#define OPENR_MCOOP_H

#include <Types.h>
#include <stdlib.h>

typedef slongword sError;
const sError sSUCCESS = 0;

/// @param[out] address at least `size` bytes
/// @return sSUCCESS, or another value if there is not enough memory
inline sError NewRegion(size_t size, void** address) {
  *address = malloc(size);
  return *address != 0 ? sSUCCESS : 1;
}

/// Frees memory from NewRegion().
inline sError DeleteRegion(void* address) {
  free(address);
  return sSUCCESS;
}

#endif  // OPENR_MCOOP_H
