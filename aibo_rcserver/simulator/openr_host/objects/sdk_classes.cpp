// The SDK's classes OObject, OSubject, OObserver and RCRegion.
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <OPENR/RCRegion.h>

#include <cstring>
#include <new>
#include <stdexcept>

#include "simulator/openr_host/objects/gates.h"
#include "simulator/openr_host/objects/system.h"

namespace {

/// A gate of an object, which must have been registered.
template <typename Service>
Service& registered(Service* service) {
  if (service == nullptr) {
    throw std::logic_error("a subject or observer is used before REGISTER_ALL_ENTRY");
  }
  return *service;
}

}  // namespace

OObject::OObject() {}

OObject::~OObject() {}

OStatus OObject::DoInit(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OStatus OObject::DoStart(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OStatus OObject::DoStop(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OStatus OObject::DoDestroy(const OSystemEvent& /*event*/) {
  return oSUCCESS;
}

OSubject::OSubject() : service_(nullptr) {}

OSubject::~OSubject() {
  delete service_;
}

void OSubject::Register(OID object, int index) {
  if (service_ == nullptr) {
    openr_host::System& system = openr_host::System::current();
    service_ = new openr_host::SubjectService(system, {object, static_cast<Selector>(index)});
    system.add(*service_);
  }
}

void OSubject::Enable(bool enabled) {
  registered(service_).enable(enabled);
}

OStatus OSubject::SetData(RCRegion* region) {
  registered(service_).setData(region);
  return oSUCCESS;
}

OStatus OSubject::SetData(const ObserverID& observer, RCRegion* region) {
  registered(service_).setData(observer, region);
  return oSUCCESS;
}

OStatus OSubject::SetData(const void* data, size_t size) {
  auto* region = new RCRegion(size);
  std::memcpy(region->Base(), data, size);
  const OStatus status = SetData(region);
  region->RemoveReference();
  return status;
}

OStatus OSubject::NotifyObservers() {
  registered(service_).notifyAll();
  return oSUCCESS;
}

OStatus OSubject::NotifyObserver(const ObserverID& observer) {
  registered(service_).notify(observer);
  return oSUCCESS;
}

int OSubject::IsReady(const ObserverID& observer) const {
  return ReadyStatus(observer) > 0 ? 1 : 0;
}

int OSubject::IsAnyReady() const {
  return registered(service_).isAnyReady() ? 1 : 0;
}

int OSubject::IsAllReady() const {
  return registered(service_).isAllReady() ? 1 : 0;
}

int OSubject::ReadyStatus(const ObserverID& observer) const {
  switch (registered(service_).readiness(observer)) {
    case openr_host::Readiness::kAssertReady:
      return 1;
    case openr_host::Readiness::kDeassertReady:
      return -1;
    case openr_host::Readiness::kUnknown:
      break;
  }
  return 0;
}

OStatus OSubject::SetBufferSize(size_t size) {
  if (size == 0) {
    return oINVALID_ARG;
  }
  registered(service_).setBufferSize(size);
  return oSUCCESS;
}

size_t OSubject::GetBufferSize() const {
  return registered(service_).bufferSize();
}

size_t OSubject::RemainBuffer(const ObserverID& observer) const {
  return registered(service_).roomFor(observer);
}

OStatus OSubject::ClearBuffer() {
  registered(service_).clear();
  return oSUCCESS;
}

OObserver::OObserver() : service_(nullptr) {}

OObserver::~OObserver() {
  delete service_;
}

void OObserver::Register(OID object, int index) {
  if (service_ == nullptr) {
    openr_host::System& system = openr_host::System::current();
    service_ = new openr_host::ObserverService(system, {object, static_cast<Selector>(index)});
    system.add(*service_);
  }
}

OStatus OObserver::AssertReady() {
  registered(service_).announceReady(true);
  return oSUCCESS;
}

OStatus OObserver::AssertReady(const SubjectID& subject) {
  registered(service_).announceReady(subject, true);
  return oSUCCESS;
}

OStatus OObserver::DeassertReady() {
  registered(service_).announceReady(false);
  return oSUCCESS;
}

OStatus OObserver::DeassertReady(const SubjectID& subject) {
  registered(service_).announceReady(subject, false);
  return oSUCCESS;
}

void OObserver::SetBufCtrlParam(size_t skip, size_t min, size_t max) {
  registered(service_).setBufferControl({skip, min, max});
}

int OObserver::NumberOfSubjects() const {
  return registered(service_).numberOfSubjects();
}

RCRegion::RCRegion(size_t size)
    : memory_id_(0),
      offset_(0),
      base_(static_cast<char*>(::operator new(size))),
      size_(size),
      owns_memory_(true),
      references_(1) {
  std::memset(base_, 0, size);
}

RCRegion::RCRegion(MemoryRegionID memID, size_t offset, void* base, size_t size)
    : memory_id_(memID),
      offset_(offset),
      base_(static_cast<char*>(base)),
      size_(size),
      owns_memory_(false),
      references_(1) {}

RCRegion::~RCRegion() {
  if (owns_memory_) {
    ::operator delete(base_);
  }
}

void RCRegion::AddReference() {
  ++references_;
}

void RCRegion::RemoveReference() {
  if (--references_ == 0) {
    delete this;
  }
}
