#include "ros2/fast_peer.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <filesystem>
#include <mutex>
#include <stdexcept>

namespace tera {
namespace {

namespace fdds = eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::SerializedPayload_t;

constexpr std::chrono::seconds kPatience(60);

/// A type known only by its name: bytes in, bytes out.
class RawType : public fdds::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 1024;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    const Payload& bytes = *static_cast<Payload*>(data);
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    static_cast<Payload*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    const auto size = static_cast<std::uint32_t>(static_cast<Payload*>(data)->size());
    return [size] { return size; };
  }
  void* createData() override { return new Payload; }
  void deleteData(void* data) override { delete static_cast<Payload*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
};

template <typename Qos>
void SetQos(const FastPeer::Wish& wish, Qos* qos) {
  qos->reliability().kind =
      wish.reliable ? fdds::RELIABLE_RELIABILITY_QOS : fdds::BEST_EFFORT_RELIABILITY_QOS;
  qos->durability().kind =
      wish.transient_local ? fdds::TRANSIENT_LOCAL_DURABILITY_QOS : fdds::VOLATILE_DURABILITY_QOS;
  qos->history().kind = fdds::KEEP_LAST_HISTORY_QOS;
  qos->history().depth = 100;
  qos->endpoint().history_memory_policy =
      eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
}

fdds::DomainParticipantQos LoopbackOnly() {
  fdds::DomainParticipantQos qos = fdds::PARTICIPANT_QOS_DEFAULT;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.push_back("127.0.0.1");
  udp->receiveBufferSize = 4 << 20;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  return qos;
}

template <typename T>
T* Made(T* entity, const std::string& what) {
  if (entity == nullptr) throw std::runtime_error("Fast DDS made no " + what);
  return entity;
}

}  // namespace

struct FastPeer::Impl : fdds::DomainParticipantListener {
  struct Inbox : fdds::DataReaderListener {
    explicit Inbox(Impl* owner) : peer(owner) {}
    void on_data_available(fdds::DataReader* reader) override {
      Payload payload;
      fdds::SampleInfo info;
      while (reader->take_next_sample(&payload, &info) == ReturnCode_t::RETCODE_OK) {
        // While it matches a writer on a busy machine, Fast DDS 2.9 sometimes delivers an invalid
        // sample as valid: sequence number 0, which no writer sends, and no bytes.
        if (!info.valid_data || payload.empty()) continue;
        const std::lock_guard lock(peer->mutex);
        messages.push_back(payload);
        peer->changed.notify_all();
      }
    }
    Impl* peer;
    std::deque<Payload> messages;
  };
  using ReturnCode_t = eprosima::fastrtps::types::ReturnCode_t;

  void on_publisher_discovery(fdds::DomainParticipant*,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& found) override {
    const std::lock_guard lock(mutex);
    const auto& writer = found.info;
    const std::string topic = writer.topicName().to_string();
    if (found.status == eprosima::fastrtps::rtps::WriterDiscoveryInfo::REMOVED_WRITER) {
      offers.erase(topic);
    } else {
      offers[topic] = {writer.typeName().to_string(),
                       writer.m_qos.m_reliability.kind == fdds::RELIABLE_RELIABILITY_QOS,
                       writer.m_qos.m_durability.kind == fdds::TRANSIENT_LOCAL_DURABILITY_QOS};
    }
    changed.notify_all();
  }

  fdds::Topic* TopicFor(const Wish& wish) {
    const fdds::TypeSupport type(new RawType(wish.type));
    type.register_type(participant);
    auto* known = participant->lookup_topicdescription(wish.topic);
    if (known != nullptr) return static_cast<fdds::Topic*>(known);
    return Made(participant->create_topic(wish.topic, wish.type, fdds::TOPIC_QOS_DEFAULT),
                "topic " + wish.topic);
  }

  mutable std::mutex mutex;
  std::condition_variable changed;
  fdds::DomainParticipant* participant = nullptr;
  fdds::Publisher* publisher = nullptr;
  fdds::Subscriber* subscriber = nullptr;
  std::map<std::string, std::unique_ptr<Inbox>> inboxes;
  std::map<std::string, fdds::DataWriter*> writers;
  std::map<std::string, OfferedTopic> offers;
};

FastPeer::FastPeer(int domain_id) : impl_(std::make_unique<Impl>()) {
  impl_->participant = Made(fdds::DomainParticipantFactory::get_instance()->create_participant(
                                static_cast<std::uint32_t>(domain_id), LoopbackOnly(), impl_.get(),
                                fdds::StatusMask::none()),
                            "participant");
  impl_->publisher =
      Made(impl_->participant->create_publisher(fdds::PUBLISHER_QOS_DEFAULT), "publisher");
  impl_->subscriber =
      Made(impl_->participant->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT), "subscriber");
}

FastPeer::~FastPeer() {
  impl_->participant->set_listener(nullptr);
  impl_->participant->delete_contained_entities();
  fdds::DomainParticipantFactory::get_instance()->delete_participant(impl_->participant);
}

void FastPeer::Subscribe(const Wish& wish) {
  fdds::DataReaderQos qos = fdds::DATAREADER_QOS_DEFAULT;
  SetQos(wish, &qos);
  fdds::Topic* topic = impl_->TopicFor(wish);
  auto inbox = std::make_unique<Impl::Inbox>(impl_.get());
  Impl::Inbox* listener = inbox.get();
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->inboxes[wish.topic] = std::move(inbox);
  }
  Made(impl_->subscriber->create_datareader(topic, qos, listener), "reader of " + wish.topic);
}

std::optional<Payload> FastPeer::Next(const std::string& topic,
                                      const std::function<bool(const Payload&)>& accept) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  std::unique_lock lock(impl_->mutex);
  std::deque<Payload>& messages = impl_->inboxes.at(topic)->messages;
  while (true) {
    while (!messages.empty()) {
      Payload first = std::move(messages.front());
      messages.pop_front();
      if (accept(first)) return first;
    }
    if (impl_->changed.wait_until(lock, deadline) == std::cv_status::timeout) return std::nullopt;
  }
}

std::size_t FastPeer::Waiting(const std::string& topic) const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->inboxes.at(topic)->messages.size();
}

void FastPeer::Advertise(const Wish& wish) {
  fdds::DataWriterQos qos = fdds::DATAWRITER_QOS_DEFAULT;
  SetQos(wish, &qos);
  impl_->writers[wish.topic] = Made(impl_->publisher->create_datawriter(impl_->TopicFor(wish), qos),
                                    "writer of " + wish.topic);
}

void FastPeer::Publish(const std::string& topic, const Payload& payload) {
  Payload copy = payload;
  if (!impl_->writers.at(topic)->write(&copy)) throw std::runtime_error("Fast DDS did not write");
}

bool FastPeer::WaitForReader(const std::string& topic) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    fdds::PublicationMatchedStatus status;
    impl_->writers.at(topic)->get_publication_matched_status(status);
    if (status.current_count > 0) return true;
    usleep(5000);
  }
  return false;
}

std::optional<OfferedTopic> FastPeer::WaitForOffer(const std::string& topic) {
  std::unique_lock lock(impl_->mutex);
  const bool found =
      impl_->changed.wait_for(lock, kPatience, [&] { return impl_->offers.contains(topic); });
  if (!found) return std::nullopt;
  return impl_->offers.at(topic);
}

std::map<std::string, OfferedTopic> FastPeer::Offers() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->offers;
}

int OwnDomainId() {
  static const int id = [] {
    for (int free = 1; free <= 100; ++free) {
      const auto file = std::filesystem::temp_directory_path() /
                        ("tera_ros2_test_domain_" + std::to_string(free));
      const int lock = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (lock < 0) continue;  // somebody else's
      if (flock(lock, LOCK_EX | LOCK_NB) == 0) return free;
      close(lock);
    }
    throw std::runtime_error("no DDS domain from 1 to 100 is free");
  }();
  return id;
}

}  // namespace tera
