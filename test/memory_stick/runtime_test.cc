// Uses the headers and the runtime for Debian's compiler, memory_stick/debian, as the robot's programs and OPEN-R's
// libraries do, on this computer and without its C++ library. Prints what does not hold; the output of cout is compared
// by memory_stick_test.py.
#include <stdio.h>
#include <string.h>

#include <algorithm>
#include <iostream>
#include <list>
#include <new>

namespace {

int failures = 0;

void expect(bool holds, int line) {
  if (!holds) {
    ++failures;
    printf("line %d\n", line);
  }
}

#define EXPECT(what) expect(what, __LINE__)

void testAlgorithms() {
  int numbers[] = {5, 3, 9, 3, 1};
  EXPECT(std::min(2, 1) == 1 && std::max(2, 1) == 2);
  EXPECT(std::count(numbers, numbers + 5, 3) == 2);
  EXPECT(std::find(numbers, numbers + 5, 9) == numbers + 2);
  EXPECT(std::find(numbers, numbers + 5, 8) == numbers + 5);
  std::sort(numbers, numbers + 5);
  const int sorted[] = {1, 3, 3, 5, 9};
  EXPECT(std::equal(sorted, sorted + 5, numbers));
  std::sort(numbers, numbers);  // nothing
  int copy[5] = {};
  EXPECT(std::copy(numbers, numbers + 4, copy) == copy + 4);
  EXPECT(!std::equal(sorted, sorted + 5, copy) && std::equal(sorted, sorted + 4, copy));
  std::fill(copy, copy + 3, 7);
  EXPECT(copy[2] == 7 && copy[3] == 5);
}

/// A list is one pointer to a ring, whose end has no value.
void testList() {
  typedef std::ListNode<int> Node;
  Node end = {&end, &end, 0}, first = {&end, &end, 1}, second = {&end, &first, 2};
  Node* pointer = &end;
  EXPECT(sizeof(std::list<int>) == sizeof pointer);
  std::list<int>& list = reinterpret_cast<std::list<int>&>(pointer);
  EXPECT(list.empty() && list.size() == 0 && list.begin() == list.end());
  end.next = &first;
  first.next = end.previous = &second;
  EXPECT(!list.empty() && list.size() == 2 && list.front() == 1);
  std::list<int>::const_iterator place = list.begin();  // of an iterator
  EXPECT(*place++ == 1 && *place == 2 && ++place == list.end());
  *list.begin() = 5;
  EXPECT(first.value == 5);
}

void testMemory() {
  int* const numbers = new int[3];
  EXPECT(new (numbers + 1) int(4) == numbers + 1 && numbers[1] == 4);
  delete[] numbers;
  delete new int;
}

}  // namespace

int main() {
  testAlgorithms();
  testList();
  testMemory();
  std::cout << "text " << -5 << " " << 7u << " " << reinterpret_cast<const void*>(0x1a) << std::endl;
  return failures;
}
