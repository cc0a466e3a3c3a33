#include "dataset/import/pictures/camera_channel.h"

#include <fmt/format.h>

#include <iterator>

#include "core/config/listed_folder.h"
#include "core/config/plain_name.h"
#include "core/error.h"
#include "core/types/mounting.h"
#include "dataset/files/checked_file.h"
#include "dataset/format/channel.h"
#include "dataset/format/sensor_sheet.h"
#include "dataset/import/imported_frames.h"
#include "dataset/import/pictures/camera_topic.h"
#include "dataset/import/scans/packet_topic.h"
#include "dataset/import/stamped_files.h"

namespace tera {
namespace {

using TakePicture = std::function<void(StampedPicture picture, const std::string& place)>;

/// Options and receivers for reading images.
struct PictureReading {
  bool skips_bad = false;
  LeaveOut leave_out;
  TakePicture take;
  std::int64_t pieces = 0;  ///< number of messages or files read, including faulty ones
};

struct CameraPlan {
  std::string folder;
  ImportedSensor sensor;
  std::filesystem::path file;  ///< file or folder
  std::optional<CameraLens> lens;
  double offset_s = 0;  ///< time offset from the key `time`
  std::function<void(PictureReading* reading)> read;
};

/// The key `model` of sensor.yaml, in the form that simulated cameras use.
std::string LensModelYaml(const CameraLens& c) {
  std::string yaml = fmt::format(
      "model:\n  width_px: {}\n  height_px: {}\n  fx_px: {}\n  fy_px: {}\n  cx_px: {}\n  cy_px: "
      "{}\n  lens: {}\n",
      c.width_px, c.height_px, c.fx_px, c.fy_px, c.cx_px, c.cy_px, c.law);
  const std::pair<const char*, double> coefficients[] = {{"k1", c.k1}, {"k2", c.k2}, {"p1", c.p1},
                                                         {"p2", c.p2}, {"k3", c.k3}, {"k4", c.k4},
                                                         {"k5", c.k5}, {"k6", c.k6}};
  for (const auto& [key, value] : coefficients) {
    if (value != 0) fmt::format_to(std::back_inserter(yaml), "  {}: {}\n", key, value);
  }
  return yaml;
}

std::string CameraSheet(const CameraPlan& plan, const ImportedFrames& frames) {
  std::string text = fmt::format("type: {}\nname: {}\n", plan.sensor.type, plan.sensor.name);
  if (!plan.sensor.link.empty()) text += MountingYaml(plan.sensor.link, plan.sensor.X_LS);
  text += frames.RateYaml();
  if (plan.lens) text += LensModelYaml(*plan.lens);
  return text + fmt::format("imported_from: {}\n", YamlQuoted(plan.file.filename().string()));
}

/// Reads the images, and writes them unless the import only checks.
class CameraImport {
 public:
  CameraImport(const CameraPlan& plan, ImportRun* run)
      : plan_(plan), run_(run), frames_(plan.folder, run) {}

  void Run() {
    DatasetWriter* const writer = run_->writer();
    if (writer != nullptr) {
      channel_ = writer->AddChannel({.path = plan_.folder,
                                     .type = std::string(kCameraChannel),
                                     .form = ChannelForm::kPictures,
                                     .sensor_yaml = CameraSheet(plan_, frames_),
                                     .columns = {}});
    }
    PictureReading reading{
        .skips_bad = run_->options().skips_bad_rows,
        .leave_out = [this](const InputError& fault) { frames_.LeaveOut(fault); },
        .take = [this](StampedPicture picture,
                       const std::string& place) { Take(std::move(picture), place); }};
    plan_.read(&reading);
    ImportedChannel* told = frames_.Report(plan_.file, reading.pieces);
    if (width_px_ > 0) {
      told->remarks.push_back(fmt::format("pictures of {} x {} px, {}", width_px_, height_px_,
                                          is_depth_ ? "depth" : "colour"));
    }
    if (!plan_.lens)
      told->remarks.push_back("without a lens: projections into these pictures are impossible");
    // sensor.yaml is written last, because it needs the frame rate.
    if (writer != nullptr) {
      WriteWholeFile(writer->PathFor(plan_.folder + "/sensor.yaml"), CameraSheet(plan_, frames_));
    }
  }

 private:
  void Take(StampedPicture stamped, const std::string& place) {
    ImportedPicture& picture = stamped.picture;
    RequireGrid(picture, place);
    const auto t_ns = frames_.Take(stamped.t_ns, plan_.offset_s, place, "picture");
    if (!t_ns || run_->writer() == nullptr) return;
    CameraFrame frame;
    frame.t_ns = frame.t_available_ns = *t_ns;
    frame.rgb = std::move(picture.rgb);
    frame.depth_m = std::move(picture.depth_m);
    run_->writer()->Write(channel_, std::move(frame));
  }

  /// Throws InputError unless all images have one size and one kind. The size is that of the lens
  /// or, without a lens, of the first image.
  void RequireGrid(const ImportedPicture& picture, const std::string& place) {
    const int width_px = picture.width_px(), height_px = picture.height_px();
    if (width_px_ == 0) {
      width_px_ = plan_.lens ? plan_.lens->width_px : width_px;
      height_px_ = plan_.lens ? plan_.lens->height_px : height_px;
      is_depth_ = picture.rgb.empty();
    }
    if (width_px != width_px_ || height_px != height_px_) {
      throw InputError(
          place, {FaultKind::kInconsistent,
                  fmt::format("its picture has {} x {} px, {} {} x {}; need one size, that of the "
                              "camera's CameraInfo or 'lens'",
                              width_px, height_px, plan_.lens ? "the lens is of" : "the first had",
                              width_px_, height_px_)});
    }
    if (picture.rgb.empty() == is_depth_) return;
    throw InputError(
        place,
        {FaultKind::kInconsistent,
         fmt::format("is a picture of {}, earlier ones are of {}; import them as two cameras",
                     is_depth_ ? "colour" : "depth", is_depth_ ? "depth" : "colour")});
  }

  const CameraPlan& plan_;
  ImportRun* run_;
  ImportedFrames frames_;
  ChannelId channel_ = 0;
  int width_px_ = 0, height_px_ = 0;
  bool is_depth_ = false;
};

/// Reads the keys of a camera in the mapping.
class CameraKeys {
 public:
  CameraKeys(const ConfigMap& channel, const ConfigMap& top, UnpackedFiles* unpacked,
             CameraPlan* plan)
      : channel_(channel), top_(top), unpacked_(unpacked), plan_(plan) {}

  void Read() {
    if (channel_.Has("files")) {
      ReadFolder();
    } else {
      ReadBagTopic();
    }
    // Keys that were not read because of an earlier fault must not be reported as unknown.
    for (const char* key :
         {"topic", "info", "rectified", "lens", "uncalibrated", "time", "times"}) {
      channel_.Has(key);
    }
  }

 private:
  void ReadFolder() {
    const StampedFiles stamped = ReadStampedFiles(channel_, {".png", ".jpg", ".jpeg"}, "pictures");
    plan_->file = stamped.folder;
    ReadLens(nullptr);
    if (const auto time = channel_.OptionalMap("time")) {
      time->Choice("column", {"stamp"}, "stamp");
      plan_->offset_s = time->Number("offset", Any("s"), 0);
    }
    plan_->read = [stamped](PictureReading* reading) {
      for (std::size_t k = 0; k < stamped.files.size(); ++k) {
        ++reading->pieces;
        const std::string place = stamped.files[k].string();
        try {
          reading->take(
              {stamped.times_ns[k], DecodePictureFile(ReadWholeFile(stamped.files[k]), place)},
              place);
        } catch (const InputError& fault) {
          reading->leave_out(fault);
        }
      }
    };
  }

  void ReadBagTopic() {
    const auto files = FilesOrList(channel_.Has("file") ? channel_ : top_, "file", kBagMetadata);
    if (files.size() != 1) {
      if (files.size() > 1)
        channel_.Fault("file", "names several files; need one file of pictures");
      return;
    }
    plan_->file = files.front();
    if (!LooksLikeBag(plan_->file)) {
      channel_.Fault(
          "file",
          {FaultKind::kUnsupported,
           fmt::format(
               "{} is not a bag; need a bag with 'topic', or a folder of pictures in 'files'",
               plan_->file.string())});
      return;
    }
    const auto topic = ReadNamedTopic(channel_, "topic", plan_->file, unpacked_);
    if (!topic) return;
    if (topic->type != kImageType && topic->type != kCompressedImageType) {
      channel_.Fault("topic", {FaultKind::kUnsupported,
                               fmt::format("has the type {}; need {} or {}", topic->type,
                                           kImageType, kCompressedImageType)});
      return;
    }
    ReadLens(&*topic);
    bool by_log_time = false;
    if (const auto time = channel_.OptionalMap("time")) {
      by_log_time = time->Choice("column", {kHeaderStamp, kLogTime}, kHeaderStamp) == kLogTime;
      plan_->offset_s = time->Number("offset", Any("s"), 0);
    }
    plan_->read = [file = plan_->file, topic = *topic, unpacked = unpacked_,
                   by_log_time](PictureReading* reading) {
      ReadMessages(file, topic, unpacked, reading->skips_bad, reading->leave_out,
                   [&](const BagMessage& message, const std::string& place) {
                     ++reading->pieces;
                     reading->take(ReadPictureMessage(topic, message, place, by_log_time), place);
                   });
    };
  }

  /// Reads `info`, `lens` or `uncalibrated`. One of them is required.
  void ReadLens(const BagTopic* topic) {
    const bool is_uncalibrated = channel_.Boolean("uncalibrated", false);
    const int given =
        (channel_.Has("info") ? 1 : 0) + (channel_.Has("lens") ? 1 : 0) + (is_uncalibrated ? 1 : 0);
    if (given > 1) {
      channel_.Fault("", "need one of 'info', 'lens' and 'uncalibrated: true'");
    } else if (channel_.Has("lens")) {
      plan_->lens = ReadCameraLens(channel_.Map("lens"));
    } else if (channel_.Has("info") && topic != nullptr) {
      ReadInfo(*topic);
    } else if (!is_uncalibrated) {
      channel_.Fault(
          topic != nullptr ? "info" : "lens",
          {FaultKind::kMissing,
           topic != nullptr
               ? "is missing: pictures without their CameraInfo have no lens; need its topic, as "
                 "/camera/camera_info, or 'lens' with the numbers, or 'uncalibrated: true'"
               : "is missing: files of pictures have no lens; need width_px, height_px, fx_px, "
                 "fy_px, cx_px, cy_px and its law, or 'uncalibrated: true'"});
    }
  }

  void ReadInfo(const BagTopic& pictures) {
    const auto info = ReadNamedTopic(channel_, "info", plan_->file, unpacked_);
    if (!info) return;
    if (info->type != kCameraInfoType) {
      channel_.Fault("info", {FaultKind::kUnsupported, fmt::format("has the type {}; need {}",
                                                                   info->type, kCameraInfoType)});
      return;
    }
    const bool looks_rectified = pictures.name.find("rect") != pictures.name.npos;
    if (looks_rectified && !channel_.Has("rectified")) {
      channel_.Fault("rectified", {FaultKind::kMissing,
                                   "is missing: the topic's name suggests rectified pictures; need "
                                   "true, for the lens P of CameraInfo, or false, for K and D"});
      return;
    }
    try {
      plan_->lens =
          ReadCameraInfo(plan_->file, *info, unpacked_, channel_.Boolean("rectified", false));
    } catch (const InputError& fault) {
      channel_.Fault("info", fault.AsFinding());
    }
  }

  const ConfigMap& channel_;
  const ConfigMap& top_;
  UnpackedFiles* unpacked_;
  CameraPlan* plan_;
};

}  // namespace

ImportJob ReadCamera(const ConfigMap& config, const ConfigMap& top, Mapping* mapping) {
  CameraPlan plan;
  plan.folder = ReadPath(config, "", mapping);
  plan.sensor = ReadSensorMount(config, std::string(kCameraChannel));
  CameraKeys(config, top, mapping->unpacked, &plan).Read();
  return [plan](ImportRun* run) { CameraImport(plan, run).Run(); };
}

}  // namespace tera
