"""Writes the SQLite 3 file of a rosbag2 as its recorder lays it out (schema version 3), with the sqlite3 of Python.

    /usr/bin/python3 write_rosbag2.py FILE none|zstd

With zstd each message is a frame of the program zstd.

Topics: /fix (sensor_msgs/msg/NavSatFix, four messages a second apart: no fix and no position, a fix, one of
a satellite-based, one of a ground-based augmentation with 1 cm), /picture (a type that nobody knows, 1 MB each).
"""
import math
import sqlite3
import struct
import subprocess
import sys


class Cdr:
    def __init__(self):
        self.body = b""

    def add(self, form, *values):
        for value in values:
            size = struct.calcsize("<" + form)
            self.body += b"\0" * (-len(self.body) % size) + struct.pack("<" + form, value)
        return self

    def text(self, text):
        self.add("I", len(text) + 1)
        self.body += text.encode() + b"\0"
        return self

    def bytes(self):
        return b"\0\1\0\0" + self.body


def fix(second, status, lat, lon, alt, variance):
    message = Cdr().add("i", second).add("I", 500).text("gps").add("b", status).add("H", 1).add("d", lat, lon, alt)
    message.add("d", variance, 0, 0, 0, variance, 0, 0, 0, 4 * variance).add("B", 2 if variance else 0)
    return message.bytes()


def packed(message):
    if sys.argv[2] == "none":
        return message
    return subprocess.run(["zstd", "-c", "-q"], input=message, stdout=subprocess.PIPE, check=True).stdout


def main():
    database = sqlite3.connect(sys.argv[1])
    database.executescript("""
        CREATE TABLE schema(schema_version INTEGER PRIMARY KEY,ros_distro TEXT NOT NULL);
        CREATE TABLE metadata(id INTEGER PRIMARY KEY,metadata_version INTEGER NOT NULL,metadata TEXT NOT NULL);
        CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,
                            serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL);
        CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL,
                              data BLOB NOT NULL);
        CREATE INDEX timestamp_idx ON messages (timestamp ASC);
        INSERT INTO schema VALUES(3, 'humble');""")
    database.execute("INSERT INTO topics VALUES(1, '/fix', 'sensor_msgs/msg/NavSatFix', 'cdr', '')")
    database.execute("INSERT INTO topics VALUES(2, '/picture', 'their_msgs/msg/Picture', 'cdr', '')")
    fixes = [fix(10, -1, math.nan, math.nan, math.nan, 0), fix(11, 0, 46.78, -71.27, 91, 4.0),
             fix(12, 1, 46.78, -71.27, 92, 1.0), fix(13, 2, 46.781, -71.27, 93, 1e-4)]
    for k, message in enumerate(fixes):
        time = (10 + k) * 10**9 + 777
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(1, ?, ?)", (time, packed(message)))
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(2, ?, ?)",
                         (time, b"\0\1\0\0" + bytes(10**6)))
    database.commit()


main()
