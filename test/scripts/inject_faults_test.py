"""Each kind of fault of scripts/inject_faults.py, on a recording made up here, by numbers from geometry."""

import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).parents[2] / "scripts/inject_faults.py"
sys.path.insert(0, str(SCRIPT.parent))
import inject_faults  # noqa: E402

IMU = "t_ns,wx_radps,wy_radps,wz_radps,ax_mps2,ay_mps2,az_mps2"
GNSS = "t_ns,lat_deg,lon_deg,alt_m,east_m,north_m,up_m,fix,var_e_m2,var_n_m2,var_u_m2"
G = 9.80665
PITCH = math.radians(30)    # The machine looks north, its nose up by this; its left is in the west.
UP_B = (math.sin(PITCH), 0, math.cos(PITCH))
TILTED_UP = 1.5 * math.cos(PITCH)


def table(header, rows):
    return header + "\n" + "".join(",".join(map(str, row)) + "\n" for row in rows)


def sensor_yaml(link, xyz_m, rpy_deg=(0, 0, 0)):
    blocks = ["".join(f"\n  - {x}" for x in triple) for triple in (xyz_m, rpy_deg)]
    return f"type: any\nparent_link: {link}\nX_parent_sensor:\n  xyz_m:{blocks[0]}\n  rpy_deg:{blocks[1]}\nrate_hz: 100\n"


def antenna(east_m, fix_lost_at=None):
    north_m = -1.5 * math.sin(PITCH)
    return table(GNSS, [(k * 100000000, 0, 0, 0, *((0, 0, 0, 0) if k == fix_lost_at else (east_m, north_m, TILTED_UP, 4)),
                         1e-4, 1e-4, 4e-4) for k in range(41)])


FILES = {
    "dataset.yaml": "format: 1\n",
    "m/imu_boom/data.csv": table(IMU, [(k * 10000000, 0.1, 0.2, 0.3, 1, 2, 9) for k in range(1, 401)]),
    "m/imu_boom/sensor.yaml": sensor_yaml("boom", (1, 0, 0)),
    # A unit that turns about the vertical with 0.5 rad/s2, and is mounted with its x to the left.
    "m/imu_turning/data.csv": table(IMU, [(k * 10000000, 0, 0, 0.005 * k, 0, 0, G) for k in range(1, 401)]),
    "m/imu_turning/sensor.yaml": sensor_yaml("turntable", (0, 0, 0), (0, 0, 90)),
    "m/imu_step/data.csv": table(IMU, [(k * 10000000, *(6 * [0 if k < 101 else 1])) for k in range(1, 401)]),
    "m/imu_step/sensor.yaml": sensor_yaml("arm", (0, 0, 0)),
    "m/imu_chassis/data.csv": table(IMU, [(k * 10000000, 0, 0, 0, *(G * u for u in UP_B)) for k in range(401)]),
    "m/imu_chassis/sensor.yaml": sensor_yaml("chassis", (0, 0, 0)),
    "m/gnss_left/data.csv": antenna(-0.5, fix_lost_at=20),
    "m/gnss_left/sensor.yaml": sensor_yaml("chassis", (0, 0.5, 1.5)),
    "m/gnss_right/data.csv": antenna(0.5),
    "m/gnss_right/sensor.yaml": sensor_yaml("chassis", (0, -0.5, 1.5)),
    "m/encoders/data.csv": table("t_ns,boom_rad,boom_radps,stick_m,stick_mps", [(k * 20000000, "0.50", 1, 2, 3) for k in range(201)]),
    "m/tracks/data.csv": table("t_ns,left_track_rad,right_track_rad,left_track_radps,right_track_radps",
                               [(k * 20000000, 3.8, 4.2, 1.9, 2.1) for k in range(201)]),
    "m/tilt/data.csv": table("t_ns,tilt_rad,tilt_radps", [(k * 20000000, 0, 0) for k in range(201)]),
    "m/commands.csv": table("t_ns,boom,stick,left_track,right_track",
                            [(k * 20000000, *([-1, 0, 0.5, 0.25][k % 4:] + [-1, 0, 0.5, 0.25][:k % 4])[:1], 1 if k >= 2 else 0, 0.19, 0.21)
                             for k in range(201)]),
    "truth/m/pose.csv": table("t_ns,x_m,y_m,z_m,qw,qx,qy,qz,vx_mps,vy_mps,vz_mps,wx_radps,wy_radps,wz_radps",
                              [(k * 100000000, 1, 0, 2, math.cos(math.radians(60)), 0, 0, math.sin(math.radians(60)), 0.5, 0, 0, 0.1, 0, 0)
                               for k in range(41)]),
}


class Injected(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.work = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.work.name)
        cls.recording = cls.root / "recording"
        for name, text in FILES.items():
            file = cls.recording / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)

    @classmethod
    def tearDownClass(cls):
        cls.work.cleanup()

    def inject(self, *faults, seed=1):
        out = pathlib.Path(tempfile.mkdtemp(dir=self.root)) / "out"
        inject_faults.inject(self.recording, out, faults, seed)
        return out

    def rows(self, folder, name):
        with open(folder / name, newline="") as stream:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(stream)]

    def changed(self, out):
        return {name for name, text in FILES.items() if (out / name).read_text() != text}

    def expect(self, row, **values):
        for name, value in values.items():
            self.assertAlmostEqual(row[name], value, places=6, msg=name)

    def expect_late(self, out, *names, late_ns):
        self.assertEqual(self.changed(out), set(names))
        for name in names:
            before, after = self.rows(self.recording, name), self.rows(out, name)
            self.assertEqual({b["t_ns"] - a["t_ns"] for a, b in zip(before, after)}, {late_ns})
            self.assertEqual([{**row, "t_ns": 0} for row in before], [{**row, "t_ns": 0} for row in after])

    def refused(self, *faults):
        with self.assertRaises(inject_faults.FaultError) as caught:
            self.inject(*faults)
        return str(caught.exception)

    def test_every_kind_is_injected_here(self):
        tests = pathlib.Path(__file__).read_text()
        self.assertEqual([kind for kind in inject_faults.KINDS if f'"{kind}:' not in tests], [])

    # Inertial units

    def test_a_bias_is_added_to_its_axis_alone(self):
        out = self.inject("imu_bias:sensor=imu_boom,gyro_y_radps=0.01,accel_z_mps2=-0.5")
        self.assertEqual(self.changed(out), {"m/imu_boom/data.csv"})
        self.expect(self.rows(out, "m/imu_boom/data.csv")[7], t_ns=80000000, wx_radps=0.1, wy_radps=0.21, wz_radps=0.3, ax_mps2=1, az_mps2=8.5)

    def test_a_scale_multiplies_its_axis_alone(self):
        row = self.rows(self.inject("imu_scale:sensor=imu_boom,gyro_z=1.1,accel_x=0.9"), "m/imu_boom/data.csv")[7]
        self.expect(row, wx_radps=0.1, wy_radps=0.2, wz_radps=0.33, ax_mps2=0.9, ay_mps2=2, az_mps2=9)

    def test_a_unit_yawed_by_90_degrees_reads_what_was_y_on_x(self):
        row = self.rows(self.inject("imu_mount:sensor=imu_boom,yaw_deg=90"), "m/imu_boom/data.csv")[7]
        self.expect(row, wx_radps=0.2, wy_radps=-0.1, wz_radps=0.3, ax_mps2=2, ay_mps2=-1, az_mps2=9)

    def test_roll_comes_before_pitch_in_a_mount(self):
        # Roll by 90 deg brings y up, and pitch by 90 deg then x down and up to the front: x reads -z, y reads x, z reads -y.
        row = self.rows(self.inject("imu_mount:sensor=imu_boom,roll_deg=90,pitch_deg=90"), "m/imu_boom/data.csv")[7]
        self.expect(row, wx_radps=-0.3, wy_radps=0.1, wz_radps=-0.2, ax_mps2=-9, ay_mps2=1, az_mps2=-2)

    def test_a_unit_farther_out_on_a_turntable_feels_the_turn(self):
        # At 2 s the table turns with 1 rad/s. 0.4 m ahead of the axis the force is 0.4 m/s2 inwards and 0.5 * 0.4 to the left;
        # the unit's x looks to the left, its y backwards.
        row = self.rows(self.inject("imu_lever_arm:sensor=imu_turning,x_m=0.4"), "m/imu_turning/data.csv")[199]
        self.expect(row, t_ns=2e9, wz_radps=1, ax_mps2=0.2, ay_mps2=0.4, az_mps2=G)

    def test_a_late_unit_has_later_stamps_and_the_same_values(self):
        self.expect_late(self.inject("imu_late:sensor=imu_boom,late_s=0.05"), "m/imu_boom/data.csv", late_ns=50000000)

    def test_a_filtered_step_has_come_to_63_percent_after_its_time_constant(self):
        rows = self.rows(self.inject("imu_filter:sensor=imu_step,time_constant_s=0.1"), "m/imu_step/data.csv")
        for column in ("wx_radps", "az_mps2"):
            self.assertEqual(rows[99][column], 0)
            self.assertAlmostEqual(rows[109][column], 0.632120559, places=8)

    def test_exchanged_axes_read_each_other(self):
        row = self.rows(self.inject("imu_axis_swap:sensor=imu_boom,axes=xz"), "m/imu_boom/data.csv")[7]
        self.expect(row, wx_radps=0.3, wy_radps=0.2, wz_radps=0.1, ax_mps2=9, ay_mps2=2, az_mps2=1)

    # Receivers

    def test_an_antenna_farther_ahead_is_farther_north_and_up_where_the_nose_looks_there(self):
        out = self.inject("gnss_lever_arm:sensor=gnss_left,x_m=0.3,y_m=0.1")
        rows = self.rows(out, "m/gnss_left/data.csv")
        self.assertEqual(self.changed(out), {"m/gnss_left/data.csv"})
        self.expect(rows[7], east_m=-0.6, north_m=-0.75 + 0.3 * 0.8660254, up_m=TILTED_UP + 0.15)
        self.expect(rows[20], east_m=0, north_m=0, up_m=0, fix=0)

    def test_a_datum_is_a_thousandth_of_a_degree_where_a_degree_at_the_equator_says_so(self):
        row = self.rows(self.inject("gnss_datum:sensor=gnss_right,east_m=111.31949,north_m=110.57428,up_m=2"), "m/gnss_right/data.csv")[7]
        self.expect(row, east_m=111.81949, north_m=109.82428, up_m=TILTED_UP + 2, alt_m=2)
        self.assertAlmostEqual(row["lat_deg"], 0.001, places=9)
        self.assertAlmostEqual(row["lon_deg"], 0.001, places=9)

    def test_a_late_receiver_has_later_stamps(self):
        self.expect_late(self.inject("gnss_late:sensor=gnss_left,late_s=-0.2"), "m/gnss_left/data.csv", late_ns=-200000000)

    def test_swapped_antennas_are_swapped_files(self):
        out = self.inject("gnss_antennas_swapped:first=gnss_left,second=gnss_right")
        self.assertEqual((out / "m/gnss_left/data.csv").read_text(), FILES["m/gnss_right/data.csv"])
        self.assertEqual((out / "m/gnss_right/data.csv").read_text(), FILES["m/gnss_left/data.csv"])

    # Encoders and poses

    def test_another_zero_changes_the_angle_alone(self):
        out = self.inject("encoder_zero:joint=boom,angle_deg=-90", "encoder_zero:joint=stick,travel_m=0.25")
        self.assertEqual(self.changed(out), {"m/encoders/data.csv"})
        self.expect(self.rows(out, "m/encoders/data.csv")[7], boom_rad=0.5 - 1.57079633, boom_radps=1, stick_m=2.25, stick_mps=3)
        self.assertIn("need travel_m", self.refused("encoder_zero:joint=stick,angle_deg=1"))

    def test_a_scale_of_an_encoder_is_in_angle_and_rate(self):
        out = self.inject("encoder_scale:joint=boom,factor=1.02")
        self.expect(self.rows(out, "m/encoders/data.csv")[7], boom_rad=0.51, boom_radps=1.02, stick_m=2, stick_mps=3)
        self.assertIn(",0.51,1.02,2,3\n", (out / "m/encoders/data.csv").read_text())

    def test_late_encoders_have_later_stamps(self):
        self.expect_late(self.inject("encoder_late:sensor=m/encoders,late_s=0.1"), "m/encoders/data.csv", late_ns=100000000)
        self.assertIn("is no set of encoders", self.refused("encoder_late:sensor=gnss_left,late_s=0.1"))

    def test_late_poses_have_later_stamps(self):
        self.expect_late(self.inject("poses_late:late_s=0.3"), "truth/m/pose.csv", late_ns=300000000)

    def test_a_map_turned_by_90_degrees_turns_places_headings_and_velocities(self):
        row = self.rows(self.inject("poses_turned:yaw_deg=90"), "truth/m/pose.csv")[7]
        # From 120 to 210 deg, whose half is 105 deg; the quaternion with w >= 0 is that of -150 deg.
        self.expect(row, x_m=0, y_m=1, z_m=2, qw=0.258819045, qx=0, qy=0, qz=-0.965925826, vx_mps=0, vy_mps=0.5, wx_radps=0.1)

    def test_a_higher_map_is_higher_alone(self):
        self.expect(self.rows(self.inject("poses_height:up_m=0.4"), "truth/m/pose.csv")[7], x_m=1, y_m=0, z_m=2.4)

    # The logger

    def test_all_sensors_but_encoders_are_late_with_their_clock(self):
        self.expect_late(self.inject("clock_of_all_sensors_but_encoders:late_s=0.08"), "m/imu_boom/data.csv", "m/imu_turning/data.csv",
                         "m/imu_step/data.csv", "m/imu_chassis/data.csv", "m/gnss_left/data.csv", "m/gnss_right/data.csv", "m/tilt/data.csv",
                         "truth/m/pose.csv", late_ns=80000000)

    def test_a_share_of_rows_is_lost_between_the_first_and_the_last(self):
        out = self.inject("rows_lost:share=0.25", "rows_lost:share=0.25,channel=imu_step")
        lines = FILES["m/imu_boom/data.csv"].splitlines()
        left = (out / "m/imu_boom/data.csv").read_text().splitlines()
        self.assertEqual(left, [line for line in lines if line in set(left)])
        self.assertEqual([left[1], left[-1]], [lines[1], lines[-1]])
        self.assertLess(abs(len(left) - 300), 5 * math.sqrt(400 * 0.25 * 0.75))
        self.assertLess(abs(len(self.rows(out, "m/imu_step/data.csv")) - 225), 5 * math.sqrt(400 * 0.5625 * 0.4375))
        self.assertLess(len(self.rows(out, "m/commands.csv")), 195)

    def test_stamps_scatter_as_widely_as_the_jitter_and_still_grow(self):
        for deviation_s in (0.001, 0.02):
            out = self.inject(f"jitter:deviation_s={deviation_s},channel=imu_boom")
            self.assertEqual(self.changed(out), {"m/imu_boom/data.csv"})
            stamps = [row["t_ns"] for row in self.rows(out, "m/imu_boom/data.csv")]
            self.assertTrue(all(a < b for a, b in zip(stamps, stamps[1:])))
            if deviation_s == 0.001:    # The standard error of a deviation of 400 is 3.5 %.
                scatter_s = math.sqrt(sum((t * 1e-9 - 0.01 * k) ** 2 for k, t in enumerate(stamps, 1)) / len(stamps))
                self.assertLess(abs(scatter_s / 0.001 - 1), 0.18)

    def test_the_same_seed_gives_the_same_bytes_and_another_one_others(self):
        texts = [(self.inject("jitter:deviation_s=0.001", seed=seed) / "m/tilt/data.csv").read_text() for seed in (3, 3, 4)]
        self.assertEqual(texts[0], texts[1])
        self.assertNotEqual(texts[0], texts[2])

    def test_stamps_of_one_channel_are_shifted(self):
        self.expect_late(self.inject("shift_stamps:channel=commands,late_s=0.01"), "m/commands.csv", late_ns=10000000)

    def test_a_burst_takes_out_the_rows_of_all_channels_at_the_same_time(self):
        out = self.inject("burst_loss:bursts=1,duration_s=0.5")
        lost = {t for name in ("m/imu_boom/data.csv", "m/tracks/data.csv", "truth/m/pose.csv")
                for t in {r["t_ns"] for r in self.rows(self.recording, name)} - {r["t_ns"] for r in self.rows(out, name)}}
        self.assertGreaterEqual(max(lost) - min(lost), 0.48e9)
        self.assertLess(max(lost) - min(lost), 0.5e9)
        for name in ("m/imu_boom/data.csv", "m/tracks/data.csv", "truth/m/pose.csv"):
            self.assertFalse([r for r in self.rows(out, name) if min(lost) <= r["t_ns"] <= max(lost)])

    # The machine. The boom's lever is -1, 0, 0.5, 0.25 in turn, 20 ms each; that of the stick goes from 0 to 1 at 40 ms.

    def boom(self, fault):
        out = self.inject(fault)
        self.assertEqual(self.changed(out), {"m/commands.csv"})
        return [row["boom"] for row in self.rows(out, "m/commands.csv")[:4]]

    def test_a_dead_band_lifts_levers_that_are_not_neutral(self):
        for lever, expected in zip(self.boom("lever_dead_band:lever=boom,width=0.2"), (-1, 0, 0.6, 0.4)):
            self.assertAlmostEqual(lever, expected)

    def test_a_machine_of_twice_the_gain_had_half_the_lever(self):
        self.assertEqual(self.boom("lever_gain:lever=boom,gain=2"), [-0.5, 0, 0.25, 0.125])
        self.assertIn("would have to go to 1.25", self.refused("lever_gain:lever=boom,gain=0.8"))

    def test_a_gain_of_one_direction_leaves_the_other(self):
        self.assertEqual(self.boom("lever_asymmetric_gain:lever=boom,negative=2"), [-0.5, 0, 0.5, 0.25])

    def test_a_lever_before_its_delay_moves_between_rows(self):
        out = self.inject("lever_delay:lever=stick,delay_s=0.03")
        rows = self.rows(out, "m/commands.csv")
        self.assertEqual([(r["t_ns"], r["stick"]) for r in rows[:4]], [(0, 0), (10000000, 1), (20000000, 1), (40000000, 1)])
        self.assertEqual([r["boom"] for r in rows[:4]], [-1, -1, 0, 0.5])
        self.assertEqual(len(rows), 202)

    def test_a_square_law_had_the_root_of_the_lever(self):
        for lever, expected in zip(self.boom("lever_exponent:lever=boom,exponent=2"), (-1, 0, math.sqrt(0.5), 0.5)):
            self.assertAlmostEqual(lever, expected)

    def test_a_reversed_lever_has_the_other_sign(self):
        self.assertEqual(self.boom("lever_reversed:lever=boom"), [1, 0, -0.5, -0.25])

    def test_a_missing_lever_is_zero(self):
        self.assertEqual(self.boom("lever_missing:lever=boom"), [0, 0, 0, 0])

    def test_a_one_sided_lever_has_no_negative_values(self):
        self.assertEqual(self.boom("lever_one_sided:lever=boom"), [0, 0, 0.5, 0.25])

    def test_shoes_of_unequal_tracks_move_as_they_did(self):
        # 0.95 of the left and 1.05 of the right sprocket's speed is what the shoes had.
        out = self.inject("track_difference:difference=0.1")
        self.assertEqual(self.changed(out), {"m/commands.csv", "m/tracks/data.csv"})
        self.expect(self.rows(out, "m/commands.csv")[7], left_track=0.2, right_track=0.2)
        self.expect(self.rows(out, "m/tracks/data.csv")[7], left_track_rad=4, right_track_rad=4, left_track_radps=2, right_track_radps=2)

    # All of them

    def test_faults_act_in_the_order_in_which_they_are_given(self):
        scaled_last = self.inject("encoder_zero:joint=stick,travel_m=1", "encoder_scale:joint=stick,factor=2")
        moved_last = self.inject("encoder_scale:joint=stick,factor=2", "encoder_zero:joint=stick,travel_m=1")
        self.assertEqual([self.rows(out, "m/encoders/data.csv")[0]["stick_m"] for out in (scaled_last, moved_last)], [6, 5])

    def test_what_is_not_changed_keeps_its_digits(self):
        out = self.inject("encoder_scale:joint=stick,factor=2")
        self.assertIn("20000000,0.50,1,4.0,6.0\n", (out / "m/encoders/data.csv").read_text())

    def test_what_cannot_be_put_in_is_told_by_name(self):
        for fault, words in (("imu_baas:sensor=imu_boom", "kind 'imu_baas' is not known"),
                             ("imu_late:sensor=imu_boom,late=1", "'late=1' is not known; the keys are sensor, late_s"),
                             ("imu_late:sensor=imu_boom", "late_s is missing"),
                             ("imu_late:sensor=imu_boom,late_s=nan", "late_s is 'nan'; need a number"),
                             ("imu_late:sensor=imu_bum,late_s=1", "sensor 'imu_bum': there is none; need one of m/encoders"),
                             ("imu_late:sensor=gnss_left,late_s=1", "is no inertial unit"),
                             ("rows_lost:share=0.1,channel=efforts", "the recording has no */efforts.csv"),
                             ("lever_missing:lever=slew", "the levers are boom, left_track, right_track, stick"),
                             ("encoder_zero:joint=east,travel_m=1", "0 sets of encoders"),
                             ("imu_bias:sensor=imu_boom", "changes nothing")):
            self.assertIn(words, self.refused(fault))

    def test_a_refusal_is_one_line_and_status_2_and_leaves_nothing(self):
        out = self.root / "refused"
        for fault, target in (("lever_gain:lever=boom,gain=0.5", out), ("nothing:of=it", out), ("lever_missing:lever=boom", self.recording)):
            run = subprocess.run([sys.executable, "-B", SCRIPT, self.recording, target, "--fault", fault], capture_output=True, text=True)
            self.assertEqual((run.returncode, run.stdout, run.stderr.count("\n")), (2, "", 1), run.stderr)
            self.assertEqual(sorted(f.name for f in self.root.glob("re*")), ["recording"])


if __name__ == "__main__":
    unittest.main()
