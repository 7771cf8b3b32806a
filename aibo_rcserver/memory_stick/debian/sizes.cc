#include <OPENR/OSubject.h>
