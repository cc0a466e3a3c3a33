#include "dataset/import/foreign_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <vector>

#include "core/config/spelling.h"
#include "core/error.h"
#include "dataset/files/checked_file.h"

namespace tera {
namespace fs = std::filesystem;
namespace {

using namespace std::string_view_literals;

constexpr std::size_t kFirstBytes = 4096;

/// A format with fixed bytes at an offset. In a remedy, {0} stands for the file and {1} for its
/// name without extension.
struct Magic {
  std::size_t at;
  std::string_view bytes;
  const char* name;
  const char* remedy;
};

constexpr const char* kDecodeCan =
    "decode it to a table by the machine's DBC file first, as cantools and python-can do "
    "(docs/reference/dataset.md, \"Files that are no table\")";
constexpr const char* kParquet =
    "write it as CSV first: python3 -c \"import pandas; "
    "pandas.read_parquet('{0}').to_csv('{1}.csv', index=False)\"";
constexpr const char* kFeather =
    "write it as CSV first: python3 -c \"import pandas; "
    "pandas.read_feather('{0}').to_csv('{1}.csv', index=False)\"";
constexpr const char* kJson =
    "write it as CSV first: python3 -c \"import pandas; pandas.read_json('{0}').to_csv('{1}.csv', "
    "index=False)\"";
constexpr const char* kPacketRemedy =
    "a mapping's lidars read the packets of an Ouster, a Velodyne or a Hesai "
    "(docs/reference/dataset.md, \"Importing scans of lidars\"); for fields of packets make a "
    "table: tshark -r {0} -T fields -E header=y -E separator=, -e "
    "frame.time_epoch -e FIELD > {1}.csv";
constexpr const char* kSpreadsheet =
    "write its sheet as CSV first: libreoffice --headless --convert-to csv {0}";
constexpr const char* kHdf =
    "write a data set of it as text first: h5ls -r {0} names them, h5dump -y -o {1}.txt -d NAME "
    "{0} writes one";
constexpr const char* kMdf =
    "write it as CSV first: python3 -c \"from asammdf import MDF; MDF('{0}').export('csv', "
    "'{1}.csv', single_time_base=True, raster=0.01)\"";
constexpr const char* kReceiver =
    "write it as NMEA (.nmea), or solve it with RTKLIB to a .pos file: convbin {0}, then "
    "rnx2rtkp -o {1}.pos ROVER.obs BASE.obs EPHEMERIS.nav";
constexpr const char* kRinex =
    "solve it to a .pos file with RTKLIB first: rnx2rtkp -o {1}.pos {0} BASE.obs EPHEMERIS.nav";
constexpr const char* kPicture = "tera import reads no pictures";
constexpr const char* kCloud =
    "'tera site' and 'tera register' read point clouds (docs/reference/survey.md)";
constexpr const char* kBag =
    "name the channels' topics in the mapping, or ask tera import "
    "--suggest for one";

constexpr Magic kMagics[] = {
    {0, "version https://git-lfs.github.com/spec/", "a pointer of Git LFS instead of the file",
     "fetch the file itself: git lfs pull"},
    {0, "/annex/objects/", "a pointer of git-annex instead of the file",
     "fetch the file itself: git annex get {0}"},
    {0, "\xd4\xc3\xb2\xa1", "a pcap capture of a network", kPacketRemedy},
    {0, "\xa1\xb2\xc3\xd4", "a pcap capture of a network", kPacketRemedy},
    {0, "\x4d\x3c\xb2\xa1", "a pcap capture of a network", kPacketRemedy},
    {0, "\xa1\xb2\x3c\x4d", "a pcap capture of a network", kPacketRemedy},
    {0, "\x0a\x0d\x0d\x0a", "a pcapng capture of a network", kPacketRemedy},
    {0, ";$FILEVERSION=", "a TRC log of a CAN bus by PEAK", kDecodeCan},
    {0, "***BUSMASTER Ver", "a log of a CAN bus by BUSMASTER", kDecodeCan},
    {0, "MDF     ", "an MDF measurement of ASAM (MF4, DAT)", kMdf},
    {0, "UnFinMF ", "an unfinished MDF measurement of ASAM", kMdf},
    {0, "TDSm", "a TDMS measurement of NI",
     "write it as CSV first: python3 -c \"from nptdms import TdmsFile; "
     "TdmsFile('{0}').as_dataframe(time_index=True).to_csv('{1}.csv')\""},
    {0, "ARROW1\0"sv, "a Feather table of Arrow", kFeather},
    {0, "FEA1\0"sv, "a Feather table of Arrow", kFeather},
    {0, "\x89HDF\r\n\x1a\n", "an HDF5 file", kHdf},
    {0, "MATLAB 7.3 MAT-file", "an HDF5 file by MATLAB (MAT 7.3)", kHdf},
    {0, "MATLAB 5.0 MAT-file", "a MAT file of MATLAB",
     "write it as CSV in MATLAB first: load('{0}'), writetable(timetable2table(NAME), '{1}.csv'), "
     "or read it with scipy.io.loadmat"},
    {0, "\x93NUMPY", "an array of NumPy",
     "write it as CSV first: python3 -c \"import numpy; numpy.savetxt('{1}.csv', "
     "numpy.load('{0}'), delimiter=',')\""},
    {0, "\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "an old document of Office (XLS)", kSpreadsheet},
    {0, "ASTM-E57", "an E57 point cloud", "write it as LAS first: pdal translate {0} {1}.las"},
    {0, "LASF", "a LAS point cloud", kCloud},
    {0, "# .PCD v", "a PCD point cloud", kCloud},
    {0, "VERSION .7\nFIELDS", "a PCD point cloud", kCloud},
    {0, "ply\n", "a PLY point cloud or mesh", kCloud},
    {0, "ply\r\n", "a PLY point cloud or mesh", kCloud},
    {0, "\x89MCAP0\r\n", "an MCAP bag", kBag},
    {0, "#ROSBAG V", "a ROS 1 bag", kBag},
    {0, "SQLite format 3", "an SQLite database",
     "if it is a rosbag2, name a topic; otherwise write the table as CSV first: sqlite3 -header "
     "-csv {0} 'SELECT * FROM TABLE' > {1}.csv"},
    {0, "ULog\x01\x12\x35", "a ULog of PX4",
     "rename it to {1}.ulg, the extension that tera import reads"},
    {0, "\xa3\x95\x80\x80", "a DataFlash log of ArduPilot",
     "write its messages as CSV first: mavlogdump.py --format csv --types IMU {0} > {1}.csv"},
    {0, "\xb5\x62", "a UBX log of a u-blox receiver", kReceiver},
    {0, "$@", "an SBF log of a Septentrio receiver", kReceiver},
    {0, "\xd3\x00", "a log of RTCM 3", kReceiver},
    {0, "\xaa\x44\x12", "a binary log of a NovAtel receiver", kReceiver},
    {60, "RINEX VERSION / TYPE", "a RINEX file of a receiver's observations", kRinex},
    {60, "CRINEX VERS   / TYPE", "a compressed RINEX file of a receiver's observations",
     "unpack it first: crx2rnx {0}"},
    {0, "\x1f\x8b", "packed by gzip", "unpack it first: gunzip {0}"},
    {4, "1AY&SY", "packed by bzip2", "unpack it first: bunzip2 {0}"},
    {0,
     "\xfd"
     "7zXZ\0"sv,
     "packed by xz", "unpack it first: unxz {0}"},
    {0, "\x28\xb5\x2f\xfd", "packed by zstd", "unpack it first: unzstd {0}"},
    {0, "\x04\x22\x4d\x18", "packed by lz4", "unpack it first: unlz4 {0}"},
    {0, "7z\xbc\xaf\x27\x1c", "a 7z archive", "unpack it first: 7z x {0}"},
    {0, "Rar!\x1a\x07", "a RAR archive", "unpack it first: unrar x {0}"},
    {257, "ustar", "a tar archive", "unpack it first: tar xf {0}"},
    {0, "%PDF-", "a PDF document", "ask for the numbers as CSV"},
    {0, "{\\rtf", "an RTF document", "write it as plain text first"},
    {0, "\x89PNG\r\n", "a PNG picture", kPicture},
    {0, "\xff\xd8\xff", "a JPEG picture", kPicture},
    {0, "II*\0"sv, "a TIFF picture or raster", kPicture},
    {0, "MM\0*"sv, "a TIFF picture or raster", kPicture},
    {0, "II+\0"sv, "a TIFF picture or raster", kPicture},
    {4, "ftyp", "an MP4 film", kPicture},
    {0, "\x1a\x45\xdf\xa3", "a Matroska film", kPicture},
    {0,
     "\x7f"
     "ELF",
     "a program", "name a log"},
};

/// Binary formats that begin with letters, as text tables do. A byte that cannot be text must
/// follow.
constexpr Magic kLetteredMagics[] = {
    {0, "LOGG", "a BLF log of a CAN bus by Vector", kDecodeCan},
    {0, "PAR1", "a Parquet table", kParquet},
};

bool GoesOnAsText(std::string_view text, std::size_t at) {
  const auto byte = static_cast<unsigned char>(at < text.size() ? text[at] : '\0');
  return byte == '\t' || byte == '\n' || byte == '\r' || (byte >= ' ' && byte < 0x7f);
}

bool HasAt(std::string_view text, std::size_t at, std::string_view part) {
  return text.size() >= at && text.substr(at).starts_with(part);
}

/// A ZIP archive, or a document format based on ZIP.
ForeignFile ZipKind(std::string_view first, const fs::path& name) {
  const std::string ending = name.extension().string();
  const auto has = [&](std::string_view part) { return first.find(part) != first.npos; };
  if (ending == ".npz") {
    return {"an NPZ archive of NumPy",
            "write one array of it as CSV first: python3 -c \"import numpy; "
            "numpy.savetxt('{1}.csv', numpy.load('{0}')['NAME'], delimiter=',')\""};
  }
  if (has("xl/") || has("[Content_Types].xml") || has("docProps/") || ending == ".xlsx") {
    return {"a workbook of Excel (XLSX)", kSpreadsheet};
  }
  if (has("application/vnd.oasis.opendocument")) {
    return {"a document of OpenDocument (ODS)", kSpreadsheet};
  }
  return {"a ZIP archive", "unpack it first: unzip {0}"};
}

std::string_view FirstLine(std::string_view* rest) {
  const std::size_t end = std::min(rest->find('\n'), rest->size());
  std::string_view line = rest->substr(0, end);
  rest->remove_prefix(std::min(end + 1, rest->size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// The first few words of a line.
std::vector<std::string_view> WordsOf(std::string_view line) {
  constexpr std::size_t kMost = 8;
  std::vector<std::string_view> words;
  while (words.size() < kMost) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == line.npos) break;
    line.remove_prefix(begin);
    words.push_back(line.substr(0, line.find_first_of(" \t")));
    line.remove_prefix(words.back().size());
  }
  return words;
}

bool IsMadeOf(std::string_view text, std::string_view characters) {
  return !text.empty() && text.find_first_not_of(characters) == text.npos;
}
constexpr std::string_view kHex = "0123456789abcdefABCDEF";

/// True for a line in candump format: "(1436509052.249713) can0 044#2A366C2BBA", or "can0 044 [2]
/// 2A 36". The time is optional.
bool IsCandumpLine(std::string_view line) {
  std::vector<std::string_view> words = WordsOf(line);
  if (!words.empty() && words[0].starts_with('(') && words[0].ends_with(')')) {
    words.erase(words.begin());
  }
  if (words.size() < 2) return false;
  const std::size_t hash = words[1].find('#');
  if (hash != std::string_view::npos) return IsMadeOf(words[1].substr(0, hash), kHex);
  return words.size() > 2 && IsMadeOf(words[1], kHex) && words[2].size() > 2 &&
         words[2].starts_with('[') && words[2].ends_with(']') &&
         IsMadeOf(words[2].substr(1, words[2].size() - 2), kHex);
}

/// True for the column names of a table of undecoded CAN frames (python-can, SavvyCAN).
bool NamesCanFrames(std::string_view line) {
  const std::string lower = LowerCase(std::string(line));
  const auto has = [&](std::string_view name) { return lower.find(name) != std::string::npos; };
  return (has("arbitration_id") && has("data")) || (has("id,extended") && has(",len,d1"));
}

/// Formats recognised by the first lines of a text.
std::optional<ForeignFile> TextKind(std::string_view first) {
  if (first.starts_with("\xef\xbb\xbf")) first.remove_prefix(3);
  const std::size_t begin = first.find_first_not_of(" \t\r\n");
  if (begin == first.npos) return std::nullopt;
  const std::string start = LowerCase(std::string(first.substr(begin, 16)));
  if (start.starts_with("<!doctype html") || start.starts_with("<html")) {
    return ForeignFile{"an HTML page, perhaps of a login or a server error",
                       "download the file itself again"};
  }
  if (start.starts_with("<?xml") || start.starts_with("<gpx") || start.starts_with("<kml")) {
    return ForeignFile{"a document in XML",
                       "write it as CSV first, a GPX track so: gpsbabel -t -i gpx -f {0} -o "
                       "unicsv -F {1}.csv"};
  }
  if (start.starts_with('{') || start.starts_with("[{") || start.starts_with("[[")) {
    return ForeignFile{"a document in JSON", kJson};
  }
  std::string_view rest = first;
  std::string_view line = FirstLine(&rest);
  if (IsCandumpLine(line)) return ForeignFile{"a log of a CAN bus by candump", kDecodeCan};
  if (NamesCanFrames(line)) {
    return ForeignFile{"a table of undecoded frames of a CAN bus", kDecodeCan};
  }
  const bool is_dated = line.starts_with("date ");
  for (int k = 0; k < 4; ++k, line = FirstLine(&rest)) {
    if (is_dated && line.starts_with("base ")) {
      return ForeignFile{"an ASC log of a CAN bus by Vector", kDecodeCan};
    }
    if (line.starts_with(";") && rest.substr(0, 1000).find("Message Number") != rest.npos) {
      return ForeignFile{"a TRC log of a CAN bus by PEAK", kDecodeCan};
    }
  }
  return std::nullopt;
}

std::optional<ForeignFile> KindOf(std::string_view first, const fs::path& name) {
  constexpr std::size_t kLasFormatAt = 104;
  constexpr unsigned kLazBit = 0x80;
  if (first.starts_with("PK\x03\x04") || first.starts_with("PK\x05\x06")) {
    return ZipKind(first, name);
  }
  if (first.starts_with("LASF") && first.size() > kLasFormatAt &&
      (static_cast<unsigned char>(first[kLasFormatAt]) & kLazBit) != 0) {
    return ForeignFile{"a LAZ point cloud", "write it as LAS first: pdal translate {0} {1}.las"};
  }
  for (const Magic& magic : kMagics) {
    if (!HasAt(first, magic.at, magic.bytes)) continue;
    return ForeignFile{magic.name, magic.remedy};
  }
  for (const Magic& magic : kLetteredMagics) {
    if (!first.starts_with(magic.bytes) || GoesOnAsText(first, magic.bytes.size())) continue;
    return ForeignFile{magic.name, magic.remedy};
  }
  return TextKind(first);
}

}  // namespace

std::optional<ForeignFile> ForeignFileOf(std::string_view first, const fs::path& name) {
  std::optional<ForeignFile> kind = KindOf(first, name);
  if (kind) {
    fs::path bare = name;
    kind->remedy =
        fmt::format(fmt::runtime(kind->remedy), name.string(), bare.replace_extension().string());
  }
  return kind;
}

std::optional<ForeignFile> ForeignFileOf(const fs::path& file) {
  std::error_code ignored;
  const auto kind = fs::status(file, ignored).type();
  // Only regular files are inspected: a pipe can be read only once, and a folder not at all.
  if (kind != fs::file_type::regular && kind != fs::file_type::not_found) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) FailFile(file, "reading", errno);
  std::string first(kFirstBytes, '\0');
  stream.read(first.data(), static_cast<std::streamsize>(first.size()));
  first.resize(static_cast<std::size_t>(stream.gcount()));
  return ForeignFileOf(first, file);
}

void RefuseForeignFile(const fs::path& file, std::string_view need) {
  if (const auto kind = ForeignFileOf(file)) {
    throw InputError(file.string(),
                     {FaultKind::kUnsupported,
                      fmt::format("is {}; need {}; {}", kind->name, need, kind->remedy)});
  }
}

}  // namespace tera
