#include "rcserver/motions/FileDesk.h"

#include <string.h>

unsigned FileDesk::Post(FileJob::Operation operation, const protocol::MotionName& name, const unsigned char* content,
                        size_t size) {
  FileJob* const job = jobs_.Memory();
  job->ticket = jobs_.NewTicket();
  job->operation = operation;
  strcpy(job->name, name);
  job->size = size;
  if (size > 0) {
    memcpy(job->content, content, size);
  }
  const unsigned ticket = job->ticket;
  jobs_.Send();
  return ticket;
}
