#include "ros2/wire.h"

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>
#include <dds/ddsi/q_radmin.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "dataset/ros/serializer.h"

namespace tera::ros {
namespace {

constexpr std::size_t kEncodingBytes = 4;

/// Reads the fields of a CDR message of either byte order.
class FieldReader {
 public:
  explicit FieldReader(std::string_view bytes) : bytes_(bytes) {
    is_whole_ = bytes.size() >= kEncodingBytes && bytes[0] == 0 && (bytes[1] & ~1) == 0;
    is_swapped_ = is_whole_ && bytes[1] == 0;
  }
  bool is_whole() const { return is_whole_; }

  template <typename T>
  void operator()(std::string_view, T&& value) {
    Get(value);
  }

 private:
  template <HasFields T>
  void Get(const T& part) {
    Fields(*this, part);
  }
  template <typename T>
  requires std::is_arithmetic_v<T>
  void Get(T& value) {
    at_ += (sizeof(T) - at_ % sizeof(T)) % sizeof(T);
    std::array<char, sizeof(T)> raw = {};
    if (!Has(sizeof(T))) return;
    std::copy_n(bytes_.data() + kEncodingBytes + at_, sizeof(T), raw.begin());
    if (is_swapped_) std::reverse(raw.begin(), raw.end());
    std::memcpy(&value, raw.data(), sizeof(T));
    at_ += sizeof(T);
  }
  void Get(bool& value) {
    std::uint8_t byte = 0;
    Get(byte);
    is_whole_ = is_whole_ && byte <= 1;
    value = byte == 1;
  }
  void Get(std::string& text) {
    std::uint32_t length = 0;
    Get(length);
    if (length == 0 || !Has(length)) return Fail();
    text = bytes_.substr(kEncodingBytes + at_, length - 1);
    at_ += length;
  }
  template <typename T>
  void Get(std::vector<T>& list) {
    std::uint32_t length = 0;
    Get(length);
    if (!Has(length * sizeof(T))) return;
    list.resize(length);
    for (T& item : list) Get(item);
  }
  bool Has(std::size_t size) {
    is_whole_ = is_whole_ && kEncodingBytes + at_ + size <= bytes_.size();
    return is_whole_;
  }
  void Fail() { is_whole_ = false; }

  std::string_view bytes_;
  std::size_t at_ = 0;  ///< offset, counted after the encoding header
  bool is_whole_, is_swapped_;
};

std::optional<DeltaCan> LeversOf(std::string_view bytes) {
  DeltaCan message;
  FieldReader reader(bytes);
  Fields(reader, message);
  return reader.is_whole() ? std::optional(std::move(message)) : std::nullopt;
}

/// Name of a type in DDS, such as "std_msgs::msg::dds_::Header_".
std::string WireTypeName(std::string_view type) {
  const std::size_t slash = type.find('/');
  return fmt::format("{}::msg::dds_::{}_", type.substr(0, slash), type.substr(slash + 1));
}

/// A message to write. Cyclone takes over its bytes.
struct Sample {
  mutable std::string bytes;
};

/// A message in Cyclone's representation, or its key. No type has a key.
struct WireData : ddsi_serdata {
  WireData(const ddsi_sertype* type, ddsi_serdata_kind kind, std::string message = {})
      : ddsi_serdata{}, bytes(std::move(message)) {
    ddsi_serdata_init(this, type, kind);
    // DDSI transmits multiples of four bytes. The fourth byte of the encoding header is the number
    // of padding bytes.
    const std::size_t padding = (4 - bytes.size() % 4) % 4;
    if (padding == 0) return;
    bytes.append(padding, '\0');
    bytes[3] = static_cast<char>(padding);
  }
  std::string bytes;
};

const std::string& BytesOf(const ddsi_serdata* data) {
  return static_cast<const WireData*>(data)->bytes;
}

/// Converts received bytes; null for an invalid message.
ddsi_serdata* Received(const ddsi_sertype* type, ddsi_serdata_kind kind, std::string bytes) {
  static const std::string levers = WireTypeName(DeltaCan::kType);
  if (kind == SDK_DATA && type->type_name == levers && !LeversOf(bytes)) return nullptr;
  auto* data = new WireData(type, kind);
  data->bytes = std::move(bytes);  // including padding
  return data;
}

ddsi_serdata* FromFragments(const ddsi_sertype* type, ddsi_serdata_kind kind,
                            const nn_rdata* fragment, std::size_t size) {
  std::string bytes;
  for (; fragment != nullptr; fragment = fragment->nextfrag) {
    if (fragment->maxp1 <= bytes.size()) continue;
    const unsigned char* payload =
        NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    bytes.append(reinterpret_cast<const char*>(payload) + bytes.size() - fragment->min,
                 fragment->maxp1 - bytes.size());
  }
  bytes.resize(size);
  return Received(type, kind, std::move(bytes));
}

ddsi_serdata* FromParts(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                        const ddsrt_iovec_t* parts, std::size_t size) {
  std::string bytes;
  for (ddsrt_msg_iovlen_t k = 0; k < count; ++k) {
    bytes.append(static_cast<const char*>(parts[k].iov_base), parts[k].iov_len);
  }
  bytes.resize(size);
  return Received(type, kind, std::move(bytes));
}

ddsi_serdata* FromSample(const ddsi_sertype* type, ddsi_serdata_kind kind, const void* sample) {
  return new WireData(type, kind, std::move(static_cast<const Sample*>(sample)->bytes));
}

ddsi_serdata* BytesFrom(const ddsi_serdata* data, std::size_t begin, std::size_t size,
                        ddsrt_iovec_t* part) {
  part->iov_base = const_cast<char*>(BytesOf(data).data() + begin);
  part->iov_len = size;
  return ddsi_serdata_ref(data);
}

constexpr ddsi_serdata_ops kDataOps = {
    .eqkey = [](const ddsi_serdata*, const ddsi_serdata*) { return true; },
    .get_size = [](const ddsi_serdata* data) -> std::uint32_t {
      return static_cast<std::uint32_t>(BytesOf(data).size());
    },
    .from_ser = FromFragments,
    .from_ser_iov = FromParts,
    .from_keyhash = [](const ddsi_sertype* type, const ddsi_keyhash*) -> ddsi_serdata* {
      return new WireData(type, SDK_KEY);
    },
    .from_sample = FromSample,
    .to_ser = [](const ddsi_serdata* data, std::size_t begin, std::size_t size,
                 void* to) { std::memcpy(to, BytesOf(data).data() + begin, size); },
    .to_ser_ref = BytesFrom,
    .to_ser_unref = [](ddsi_serdata* data, const ddsrt_iovec_t*) { ddsi_serdata_unref(data); },
    .to_sample = [](const ddsi_serdata*, void*, void**, void*) { return false; },
    .to_untyped = [](const ddsi_serdata* data) -> ddsi_serdata* {
      return new WireData(data->type, SDK_KEY);
    },
    .untyped_to_sample = [](const ddsi_sertype*, const ddsi_serdata*, void*, void**,
                            void*) { return true; },
    .free = [](ddsi_serdata* data) { delete static_cast<WireData*>(data); },
    .print = [](const ddsi_sertype*, const ddsi_serdata*, char* text, std::size_t) -> std::size_t {
      *text = '\0';
      return 0;
    },
    .get_keyhash = [](const ddsi_serdata*, ddsi_keyhash* hash, bool) { *hash = {}; },
#ifdef DDS_HAS_SHM
    .get_sample_size = nullptr,
    .from_iox_buffer = nullptr,
#endif
};

/// Cyclone takes messages as Sample and returns them as bytes, so it never needs to construct one.
constexpr ddsi_sertype_ops kTypeOps = {
    .version = ddsi_sertype_v0,
    .arg = nullptr,
    .free =
        [](ddsi_sertype* type) {
          ddsi_sertype_fini(type);
          delete type;
        },
    .zero_samples = [](const ddsi_sertype*, void*, std::size_t) {},
    .realloc_samples = [](void**, const ddsi_sertype*, void*, std::size_t, std::size_t) {},
    .free_samples = [](const ddsi_sertype*, void**, std::size_t, dds_free_op_t) {},
    .equal = [](const ddsi_sertype*, const ddsi_sertype*) { return true; },
    .hash = [](const ddsi_sertype*) -> std::uint32_t { return 0; },
    .type_id = nullptr,
    .type_map = nullptr,
    .type_info = nullptr,
    .derive_sertype = nullptr,
    .get_serialized_size = nullptr,
    .serialize_into = nullptr,
};

template <std::size_t... index>
constexpr std::array<std::string_view, sizeof...(index)> MessageTypes(
    std::index_sequence<index...>) {
  return {std::variant_alternative_t<index, Message>::kType...};
}

}  // namespace

std::string_view TypeOf(std::size_t index) {
  return MessageTypes(std::make_index_sequence<std::variant_size_v<Message>>()).at(index);
}

dds_entity_t CreateTopic(dds_entity_t participant, const std::string& name, std::string_view type) {
  auto own = std::make_unique<ddsi_sertype>();
  ddsi_sertype_init(own.get(), WireTypeName(type).c_str(), &kTypeOps, &kDataOps,
                    /*topickind_no_key=*/true);
  own->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  ddsi_sertype* taken = own.get();
  const dds_entity_t topic =
      dds_create_topic_sertype(participant, name.c_str(), &taken, nullptr, nullptr, nullptr);
  if (topic > 0) own.release();  // Cyclone now owns the type
  return topic;
}

dds_return_t WriteOnWire(dds_entity_t writer, const Message& message) {
  Serializer serializer(WireForm::kCdr);
  std::visit([&](const auto& m) { serializer.Put(m); }, message);
  const Sample sample{serializer.TakeBytes()};
  return dds_write(writer, &sample);
}

dds_return_t TakeFromWire(dds_entity_t reader, int most, std::vector<DeltaCan>* messages) {
  std::vector<ddsi_serdata*> data(static_cast<std::size_t>(most), nullptr);
  std::vector<dds_sample_info_t> infos(data.size());
  const dds_return_t count = dds_takecdr(reader, data.data(), static_cast<std::uint32_t>(most),
                                         infos.data(), DDS_ANY_STATE);
  for (int i = 0; i < count; ++i) {
    // A sample without data only reports that a publisher appeared or left.
    if (infos[i].valid_data) messages->push_back(*LeversOf(BytesOf(data[i])));
    ddsi_serdata_unref(data[i]);
  }
  return count;
}

}  // namespace tera::ros
