#include "rcserver/joints/EndLog.h"

#include <stdio.h>
#include <string.h>

const int EndLog::MAX_TEXT_SIZE;
const unsigned EndLog::MAX_ENDS;

void EndReason::Describe(char* text) const {
  sprintf(text, format, joint);
}

EndLog::EndLog() : added_(0) {
  taken_[CLIENT] = 0;
  taken_[CONSOLE] = 0;
}

void EndLog::Add(unsigned char what, const char* name, const EndReason& reason, bool is_for_client) {
  End& end = ends_[added_ % MAX_ENDS];
  ++added_;
  end.what = what;
  end.how = reason.how;
  strcpy(end.name, name);
  reason.Describe(end.reason);
  end.is_for_client = is_for_client;
}

bool EndLog::Take(Reader reader, End* end) {
  unsigned& taken = taken_[reader];
  if (added_ - taken > MAX_ENDS) {
    taken = added_ - MAX_ENDS;
  }
  while (taken != added_) {
    *end = ends_[taken % MAX_ENDS];
    ++taken;
    if (reader == CONSOLE || end->is_for_client) {
      return true;
    }
  }
  return false;
}
