"""Colours the scans of a lidar by what a camera sees at the same time, and writes them as one cloud in W.

    build/release/tera generate config/scenarios/quickstart.yaml --duration 2 --set record.poses_hz=200 --out out/with_poses
    PYTHONPATH=build/release/python /usr/bin/python3 examples/python/colour_cloud.py out/with_poses out/cloud.ply
"""

import sys

import numpy as np

import tera

MACHINE, CAMERA, LIDAR = "excavator1", "camera_front", "lidar_roof"


def coloured(dataset: tera.Dataset, frame: tera.Frame, scan: tera.Scan) -> tuple[np.ndarray, np.ndarray]:
    """Points in W and the colours of those pixels that show them, N x 3 each."""
    X_WS = dataset.pose(f"{MACHINE}/{LIDAR}", scan.point_t_ns)  # each point at the time of its own ray
    p_W = (X_WS[:, :3, :3] @ scan.xyz_m[:, :, None])[:, :, 0] + X_WS[:, :3, 3]
    X_WC = dataset.pose(f"{MACHINE}/{CAMERA}/optical", frame.t_ns)
    pixels, z_m = frame.lens.project(tera.transformed(np.linalg.inv(X_WC), p_W))
    seen = np.all((pixels >= 0) & (pixels <= [frame.lens.width_px - 1, frame.lens.height_px - 1]), axis=1)
    u, v = np.round(pixels[seen]).astype(int).T
    p_W, z_m = p_W[seen], z_m[seen]
    depth_m = frame.depth_m[v, u]
    shown = (depth_m == 0) | (z_m < 1.03 * depth_m)  # what is nearer hides the rest
    return p_W[shown], frame.rgb[v, u][shown]


def main(path: str, out: str) -> None:
    dataset = tera.Dataset(path)
    camera, lidar = dataset[f"{MACHINE}/{CAMERA}"], dataset[f"{MACHINE}/{LIDAR}"]
    last_ns = dataset[f"truth/{MACHINE}/sensors/{LIDAR}"].t_ns[-1]
    points, colours = [], []
    for frame in camera:
        scan = lidar.at(frame.t_ns)
        if not len(scan) or scan.point_t_ns.max() > last_ns:
            continue
        p_W, rgb = coloured(dataset, frame, scan)
        points.append(p_W)
        colours.append(rgb)
    rows = np.column_stack([np.vstack(points), np.vstack(colours)])
    properties = "".join(f"property {kind} {name}\n" for kind, names in (("float", ["x", "y", "z"]),
                                                                         ("uchar", ["red", "green", "blue"]))
                         for name in names)
    header = f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\n{properties}end_header"
    np.savetxt(out, rows, fmt=["%.4f"] * 3 + ["%d"] * 3, header=header, comments="")
    print(f"{len(rows)} points in {out}")


if __name__ == "__main__":
    main(*sys.argv[1:3])
