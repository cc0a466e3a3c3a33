"""A recording as tables of text, of which a fault changes what it must and no digit more."""

import numpy


class FaultError(Exception):
    """A fault that was asked for and cannot be put in, in words for whoever asked."""


class Table:
    """A CSV file by columns of text: what is not changed keeps its digits."""

    def __init__(self, file):
        rows = [line.split(",") for line in file.read_text().splitlines() if line]
        if not rows or any(len(row) != len(rows[0]) for row in rows):
            raise FaultError(f"{file}: not a table with one header and rows of its length")
        self.file, self.header = file, rows[0]
        self.text = {name: [row[i] for row in rows[1:]] for i, name in enumerate(rows[0])}
        self.as_read = dict(self.text)

    def __contains__(self, column):
        return column in self.text

    def numbers(self, column, kind):
        try:
            return numpy.array([kind(x) for x in self.text[column]], dtype=kind)
        except KeyError:
            raise FaultError(f"{self.file}: no column {column}; it has {','.join(self.header)}") from None
        except ValueError as error:
            raise FaultError(f"{self.file}: column {column}: {error}") from None

    def times_ns(self):
        return self.numbers("t_ns", int)

    def is_encoders(self):
        return not {"fix", "tilt_rad"} & set(self.header) and any(c.endswith(("_rad", "_m")) for c in self.header)

    def times_s(self):
        return self.times_ns() * 1e-9

    def get(self, *columns):
        """One row for each time and one column for each name; of one name, a vector."""
        values = [self.numbers(c, float) for c in columns]
        return values[0] if len(columns) == 1 else numpy.stack(values, axis=1)

    def set(self, columns, values):
        values = numpy.asarray(values, dtype=float).reshape(-1, len(columns))
        for name, new in zip(columns, values.T):
            old = self.get(name)
            self.text[name] = [text if x == y else numpy.format_float_positional(round(x, 12) + 0.0, trim="0")
                               for text, x, y in zip(self.text[name], new, old)]

    def set_times_ns(self, times_ns):
        self.text["t_ns"] = [str(int(t)) for t in times_ns]

    def delay_stamps(self, seconds):
        self.set_times_ns(self.times_ns() + round(seconds * 1e9))

    def take(self, rows):
        self.text = {name: [column[i] for i in rows] for name, column in self.text.items()}

    def write(self, file):
        columns = [self.text[name] for name in self.header]
        file.write_text("\n".join([",".join(self.header), *(",".join(row) for row in zip(*columns))]) + "\n")


class Recording:
    """The files of a recording, read when a fault asks for them."""

    GYRO, ACCELEROMETER = ("wx_radps", "wy_radps", "wz_radps"), ("ax_mps2", "ay_mps2", "az_mps2")
    PLACE = ("east_m", "north_m", "up_m")

    def __init__(self, folder):
        self.folder, self.tables = folder, {}
        if not (folder / "dataset.yaml").is_file():
            raise FaultError(f"{folder}: not a recording, for it has no dataset.yaml")
        self.sensors = sorted(f.parent for f in folder.glob("*/*/data.csv") if f.parts[-3] != "truth")

    def table(self, file):
        if file not in self.tables:
            self.tables[file] = Table(file)
        return self.tables[file]

    def sensor_folder(self, name):
        found = [f for f in self.sensors if name in (f.name, f"{f.parent.name}/{f.name}")]
        if len(found) != 1:
            names = ", ".join(f"{f.parent.name}/{f.name}" for f in self.sensors)
            raise FaultError(f"sensor '{name}': {'several have that name' if found else 'there is none'}; need one of {names}")
        return found[0]

    def sensor(self, name, needed=("t_ns",), kind="sensor"):
        folder = self.sensor_folder(name)
        table = self.table(folder / "data.csv")
        if any(c not in table for c in needed):
            raise FaultError(f"sensor '{name}' is no {kind}: its data.csv has the columns {','.join(table.header)}")
        return folder, table

    def imu(self, name):
        return self.sensor(name, self.GYRO + self.ACCELEROMETER, "inertial unit")

    def gnss(self, name):
        return self.sensor(name, (*self.PLACE, "fix"), "receiver")

    def all_of(self, needed):
        return [(f, self.table(f / "data.csv")) for f in self.sensors
                if all(c in self.table(f / "data.csv") for c in needed)]

    def axis(self, joint):
        """The table of encoders with the joint, and its columns of position and, where there is one, of rate."""
        found = [(table, [c for c in (f"{joint}_{unit}" for unit in units) if c in table])
                 for units in (("rad", "radps"), ("m", "mps")) for _, table in self.all_of([f"{joint}_{units[0]}"])
                 if table.is_encoders()]
        if len(found) != 1:
            raise FaultError(f"joint '{joint}': {len(found)} sets of encoders have a column {joint}_rad or {joint}_m; need one")
        return found[0]

    def lever(self, name):
        tables = [self.table(f) for f in sorted(self.folder.glob("*/commands.csv"))]
        found = [t for t in tables if name in t and name != "t_ns"]
        if len(found) != 1:
            levers = ", ".join(sorted({c for t in tables for c in t.header} - {"t_ns"}))
            what = "several machines have it" if found else "there is none"
            raise FaultError(f"lever '{name}': {what}; the levers are {levers}")
        return found[0]

    def poses(self):
        tables = [self.table(f) for f in sorted(self.folder.glob("truth/*/pose.csv"))]
        if not tables:
            raise FaultError("the recording has no poses (truth/<machine>/pose.csv)")
        return tables

    def channel(self, name):
        files = {"commands": "*/commands.csv", "efforts": "*/efforts.csv", "poses": "truth/*/pose.csv"}
        if name == "all":
            named = [self.table(f) for pattern in files.values() for f in sorted(self.folder.glob(pattern))]
            return named + [self.table(f / "data.csv") for f in self.sensors]
        if name in files:
            found = [self.table(f) for f in sorted(self.folder.glob(files[name]))]
            if not found:
                raise FaultError(f"channel '{name}': the recording has no {files[name]}")
            return found
        return [self.sensor(name)[1]]

    def state(self):
        return {file: dict(table.text) for file, table in self.tables.items()}
