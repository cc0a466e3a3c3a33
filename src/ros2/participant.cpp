#include "ros2/participant.h"

#include <fmt/format.h>

#include <cstdlib>

#include "core/check.h"
#include "core/error.h"
#include "ros2/names.h"
#include "ros2/wire.h"

namespace tera::ros {
namespace {

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

/// Settings of all ROS 2 topics: CDR version 1, and writes that do not block.
Qos MakeQos(dds_reliability_kind_t reliability, dds_durability_kind_t durability, int depth) {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  const dds_data_representation_id_t cdr = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &cdr);
  dds_qset_reliability(qos.get(), reliability, /*max_blocking_time=*/0);
  dds_qset_durability(qos.get(), durability);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  return qos;
}

Qos QosOf(Delivery delivery) {
  switch (delivery) {
    case Delivery::kSensorData:
      return MakeQos(DDS_RELIABILITY_BEST_EFFORT, DDS_DURABILITY_VOLATILE, 5);
    case Delivery::kLarge:
      return MakeQos(DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_VOLATILE, 2);
    case Delivery::kState:
      return MakeQos(DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_VOLATILE, 10);
    case Delivery::kTransforms:
      return MakeQos(DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_VOLATILE, 100);
    case Delivery::kLatched:
      return MakeQos(DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL, 1);
    case Delivery::kClock:
      return MakeQos(DDS_RELIABILITY_BEST_EFFORT, DDS_DURABILITY_VOLATILE, 1);
  }
  TERA_CHECK(false, static_cast<int>(delivery));
  return MakeQos(DDS_RELIABILITY_BEST_EFFORT, DDS_DURABILITY_VOLATILE, 1);
}

constexpr int kLeverDepth = 10;

/// Settings of Cyclone; CYCLONEDDS_URI overrides them. The history of a writer is bounded only by
/// its depth, so a reader that does not acknowledge does not delay others. The loopback interface
/// often does not report that it supports multicast. Participants on this computer therefore find
/// each other by multicast and by trying successive ports.
std::string Settings(bool this_host_only) {
  std::string settings =
      "<Internal><Watermarks><WhcHigh>1GB</WhcHigh><WhcHighInit>1GB</WhcHighInit></Watermarks>"
      "</Internal>";
  if (this_host_only) {
    settings +=
        "<General><Interfaces><NetworkInterface address=\"127.0.0.1\" multicast=\"true\"/>"
        "</Interfaces><AllowMulticast>spdp</AllowMulticast></General>"
        "<Discovery><ParticipantIndex>auto</ParticipantIndex>"
        "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
        "<Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>";
  }
  const char* uri = std::getenv("CYCLONEDDS_URI");
  if (uri == nullptr || *uri == '\0') return settings;
  return settings + "," + uri;
}

}  // namespace

struct Participant::Impl {
  struct Writer {
    dds_entity_t entity;
    std::size_t message_index;
  };
  dds_entity_t domain = 0, participant = 0, waitset = 0;
  std::vector<Writer> writers;
  std::vector<dds_entity_t> readers;
  std::int64_t published = 0, dropped = 0;

  /// Also deletes all entities of the participant.
  ~Impl() {
    if (participant > 0) dds_delete(participant);
    if (domain > 0) dds_delete(domain);
  }

  dds_entity_t Topic(std::string_view type, const std::string& name) const {
    const dds_entity_t topic = CreateTopic(participant, DdsTopicOf(name), type);
    TERA_CHECK(topic > 0, name, dds_strretcode(topic));
    return topic;
  }
};

Participant::Participant(const Options& options) : impl_(std::make_unique<Impl>()) {
  const auto require = [&](dds_entity_t entity) {
    if (entity > 0) return entity;
    throw InputError(
        "",
        {FaultKind::kUnsupported,
         fmt::format("DDS cannot start on domain {}: {}; need an interface of the network that is "
                     "up, and a CYCLONEDDS_URI that Cyclone DDS accepts where it is set",
                     options.domain_id, dds_strretcode(entity))});
  };
  const auto domain = static_cast<dds_domainid_t>(options.domain_id);
  impl_->domain = require(dds_create_domain(domain, Settings(options.this_host_only).c_str()));
  impl_->participant = require(dds_create_participant(domain, nullptr, nullptr));
  impl_->waitset = require(dds_create_waitset(impl_->participant));
}

Participant::~Participant() = default;

Participant::WriterId Participant::Advertise(const std::string& topic, std::size_t message_index,
                                             Delivery delivery) {
  const dds_entity_t entity = impl_->Topic(TypeOf(message_index), topic);
  const dds_entity_t writer =
      dds_create_writer(impl_->participant, entity, QosOf(delivery).get(), nullptr);
  TERA_CHECK(writer > 0, topic, dds_strretcode(writer));
  impl_->writers.push_back({writer, message_index});
  return static_cast<WriterId>(impl_->writers.size()) - 1;
}

void Participant::Publish(WriterId writer, const Message& message) {
  const Impl::Writer& to = impl_->writers.at(writer);
  TERA_CHECK(to.message_index == message.index(), to.message_index, message.index());
  const dds_return_t result = WriteOnWire(to.entity, message);
  ++(result == DDS_RETCODE_OK ? impl_->published : impl_->dropped);
}

bool Participant::HasReaders(WriterId writer) const {
  dds_publication_matched_status_t status = {};
  dds_get_publication_matched_status(impl_->writers.at(writer).entity, &status);
  return status.current_count > 0;
}

Participant::ReaderId Participant::SubscribeToLevers(const std::string& topic) {
  const dds_entity_t entity = impl_->Topic(DeltaCan::kType, topic);
  const Qos qos = MakeQos(DDS_RELIABILITY_BEST_EFFORT, DDS_DURABILITY_VOLATILE, kLeverDepth);
  const dds_entity_t reader = dds_create_reader(impl_->participant, entity, qos.get(), nullptr);
  TERA_CHECK(reader > 0, topic, dds_strretcode(reader));
  const dds_entity_t arrived = dds_create_readcondition(reader, DDS_ANY_STATE);
  TERA_CHECK(arrived > 0, topic, dds_strretcode(arrived));
  dds_waitset_attach(impl_->waitset, arrived, reader);
  impl_->readers.push_back(reader);
  return static_cast<ReaderId>(impl_->readers.size()) - 1;
}

bool Participant::HasLeverWriters(ReaderId reader) const {
  dds_subscription_matched_status_t status = {};
  dds_get_subscription_matched_status(impl_->readers.at(reader), &status);
  return status.current_count > 0;
}

std::vector<DeltaCan> Participant::TakeLevers(ReaderId reader) {
  std::vector<DeltaCan> messages;
  const dds_return_t taken = TakeFromWire(impl_->readers.at(reader), kLeverDepth, &messages);
  TERA_CHECK(taken >= 0, reader, dds_strretcode(taken));
  return messages;
}

bool Participant::WaitForLevers(double timeout_s) {
  return dds_waitset_wait(impl_->waitset, nullptr, 0, FromSeconds(timeout_s)) > 0;
}

std::int64_t Participant::published() const { return impl_->published; }
std::int64_t Participant::dropped() const { return impl_->dropped; }

}  // namespace tera::ros
