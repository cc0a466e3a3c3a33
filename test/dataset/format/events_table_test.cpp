#include "dataset/format/events_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "dataset/files/checked_file.h"
#include "own_folder.h"

namespace tera {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr char kHeader[] = "t_ns,end_ns,kind,machine,part,other,value,unit\n";

std::filesystem::path FileOf(const std::string& rows) {
  const std::filesystem::path file = OwnFolder() / "events.csv";
  WriteWholeFile(file, kHeader + rows);
  return file;
}

void ExpectRefused(const std::string& rows, const std::string& message) {
  EXPECT_THAT([&] { ReadEvents(FileOf(rows)); }, ThrowsMessage<InputError>(HasSubstr(message)));
}

TEST(EventsTable, IsWrittenInOrderAndReadsAgain) {
  const std::vector<RecordedEvent> events = {
      {30, 50, EventKind::kDrop, "", "", "box", 1.5},
      {10, 20, EventKind::kContact, "digger", "blade", "cone", 812.25}};
  const std::string text = EventsText(events);
  EXPECT_EQ(text, std::string(kHeader) +
                      "10,20,contact,digger,blade,cone,812.25,N\n30,50,drop,,,box,1.5,m\n");
  WriteWholeFile(OwnFolder() / "events.csv", text);
  const std::vector<RecordedEvent> sorted = {events[1], events[0]};
  EXPECT_EQ(ReadEvents(OwnFolder() / "events.csv"), sorted);
  EXPECT_TRUE(ReadEvents(FileOf("")).empty());
}

TEST(EventsTable, RefusesFaultyRowsWithTheirLine) {
  const std::string good = "10,20,contact,m,blade,cone,8,N\n";
  ExpectRefused(good + "10,20,contact,m,blade,cone,8\n", "events.csv:3: 7 fields, need 8");
  ExpectRefused("1.5,20,contact,m,blade,cone,8,N\n", "whole numbers");
  ExpectRefused("30,20,contact,m,blade,cone,8,N\n", "ends at 20, before it begins");
  ExpectRefused("10,20,touch,m,blade,cone,8,N\n", "unknown kind 'touch', need one of contact");
  ExpectRefused("10,20,contact,m,blade,cone,nan,N\n", "value 'nan', need a number from 0");
  ExpectRefused("10,20,contact,m,blade,cone,8,kN\n", "unit 'kN', need 'N' for contact");
  ExpectRefused(good + "9,20,contact,m,blade,cone,8,N\n", "begins at 9, before the row above it");
  ExpectRefused(good + "10,20,contact,m,bl", "the last line has no end");
  WriteWholeFile(OwnFolder() / "events.csv", "t_ns,kind\n");
  EXPECT_THAT([] { ReadEvents(OwnFolder() / "events.csv"); },
              ThrowsMessage<InputError>(HasSubstr("events.csv:1: found 't_ns,kind'")));
  EXPECT_THROW(ReadEvents(OwnFolder() / "none.csv"), InputError);
}

}  // namespace
}  // namespace tera
