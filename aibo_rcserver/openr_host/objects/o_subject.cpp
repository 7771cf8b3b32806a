#include <OPENR/OSubject.h>

#include <cstring>
#include <stdexcept>

#include "openr_host/objects/subject_service.h"
#include "openr_host/system.h"

namespace {

openr_host::SubjectService& registered(openr_host::SubjectService* service) {
  if (service == nullptr) {
    throw std::logic_error("a subject is used before REGISTER_ALL_ENTRY");
  }
  return *service;
}

}  // namespace

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

void OSubject::SetData(RCRegion* region) {
  registered(service_).setData(region);
}

void OSubject::SetData(const ObserverID& observer, RCRegion* region) {
  registered(service_).setData(observer, region);
}

void OSubject::SetData(const void* data, size_t size) {
  auto* region = new RCRegion(size);
  std::memcpy(region->Base(), data, size);
  SetData(region);
  region->RemoveReference();
}

void OSubject::NotifyObservers() {
  registered(service_).notifyAll();
}

void OSubject::NotifyObserver(const ObserverID& observer) {
  registered(service_).notify(observer);
}

bool OSubject::IsReady(const ObserverID& observer) const {
  return registered(service_).isReady(observer);
}

bool OSubject::IsAnyReady() const {
  return registered(service_).isAnyReady();
}

bool OSubject::IsAllReady() const {
  return registered(service_).isAllReady();
}

void OSubject::ClearBuffer() {
  registered(service_).clear();
}
