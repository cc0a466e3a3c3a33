#include "blind/prove.h"

#include <fmt/format.h>

#include <exception>
#include <fstream>
#include <iterator>

#include "blind/cases/recording_files.h"
#include "blind/maker.h"
#include "blind/marking/answer.h"
#include "blind/marking/seal.h"
#include "blind/marking/table.h"
#include "core/error.h"
#include "core/stopwatch.h"

namespace tera::blind {
namespace {

namespace fs = std::filesystem;

std::string TextOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void Write(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream)
    throw InputError(fmt::format("{}: cannot be written; check the disk", file.string()));
}

/// Marks the improvement of the baseline methods, and of the tool on the same cases.
void MarkImprovement(const BenchmarkCase& c, const CaseRecording& recording, const Answer& answer,
                     const fs::path& baselines_json, Mark* mark) {
  const BaselineAnswers baselines = ReadBaselines(baselines_json);
  mark->share_of_oracle = ShareOfOracle(c, recording, baselines.as_it_is, answer.rmse_after);
  mark->methods = MarkMethods(c, recording, baselines);
}

/// A tool that gives up has given an answer too: none.
Mark ProveCase(const Maker& maker, int number, const Tools& tools, const fs::path& folder) {
  const auto [c, recording] = maker(number, folder);
  const std::string truth = TruthJson(c, recording);
  SealTruth(truth, folder);
  const fs::path report = folder / "report";
  std::string fault;
  double seconds = 0;
  try {
    const Stopwatch watch(&seconds);
    tools.diagnose(folder / "scenario.yaml", folder / "recording", report);
  } catch (const std::exception& e) {
    fault = e.what();
  }
  const fs::path json = report / "diagnosis.json";
  OpenTruth(truth, fault.empty() ? TextOf(json) : fault, folder);
  const Answer answer = fault.empty() ? ReadAnswer(json) : Answer{};
  Mark mark = MarkAnswer(c, recording, answer);
  mark.fault = fault;
  mark.seconds = seconds;
  if (fault.empty() && tools.baselines) {
    tools.baselines(folder / "scenario.yaml", folder / "recording", report);
    MarkImprovement(c, recording, answer, report / "baselines.json", &mark);
  }
  return mark;
}

void WriteTables(const std::vector<Mark>& marks, std::uint64_t seed, const fs::path& out) {
  const std::vector<Row> rows = TableOf(marks);
  Write(out / "table.md", TableMarkdown(rows) + "\n" + MethodsMarkdown(MethodsOf(marks)));
  Write(out / "table.json", TableJson(rows, marks, seed));
  Write(out / "cases.md", CasesMarkdown(marks));
}

}  // namespace

std::vector<Mark> Prove(const ProveOptions& options, const Tools& tools,
                        const std::function<void(const Mark&)>& progress) {
  const Maker maker = MakerFor(options);
  std::vector<Mark> marks;
  for (int number = options.first - 1; number < options.first - 1 + options.cases; ++number) {
    const fs::path folder = options.out / fmt::format("case_{:04}", number + 1);
    marks.push_back(ProveCase(maker, number, tools, folder));
    progress(marks.back());
    WriteTables(marks, options.seed, options.out);
  }
  return marks;
}

}  // namespace tera::blind
