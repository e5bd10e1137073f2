"""Rotations: matrices into rotation and stretch, rotations into vectors and quaternions, and vectors into rotations.

References: K. Shoemake, T. Duff, Matrix Animation and Polar Decomposition (1992); O. Rodrigues (1840).
"""

import numpy as np


def polar(matrices) -> tuple[np.ndarray, np.ndarray]:
    """Return proper rotations and symmetric stretches (negative for mirrored matrices), with the products ``matrices``.

    A flat matrix counts as not mirrored: of the two orthogonal factors that it allows, the proper rotation is returned.
    """
    left, values, right = np.linalg.svd(matrices)
    flat = values[:, 2] <= 4 * np.finfo(float).eps * values[:, 0]
    left[flat, :, 2] *= np.sign(np.linalg.det(left[flat]) * np.linalg.det(right[flat]))[:, None]
    sign = np.where(np.linalg.det(left) * np.linalg.det(right) < 0, -1.0, 1.0)[:, None, None]
    return left @ right * sign, np.swapaxes(right, 1, 2) @ (values[:, :, None] * right) * sign


def transform(axes, position) -> np.ndarray:
    """Return the matrix, (4, 4), from the frame with these axes, (3, 3) by columns, at a position."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = axes, position
    return matrix


def rigid(pose: np.ndarray) -> np.ndarray:
    """Return a pose, (4, 4), whose axes are the nearest rotation."""
    turned = pose.copy()
    turned[:3, :3] = polar(pose[None, :3, :3])[0][0]
    return turned


def rotation_vector(rotation) -> np.ndarray:
    """Return axis times angle, (n, 3), of rotations by less than a half turn."""
    skew, sine, angle = sine_and_angle(rotation)
    return skew * np.where(sine > 0, angle / np.where(sine > 0, sine, 1.0), 1.0)[:, None]


def sine_and_angle(rotation):
    """Return axis times sine, (n, 3), sine and angle, (n,) each, of rotations; the angle is from 0 to pi."""
    skew = np.stack(
        [rotation[:, j, i] - rotation[:, i, j] for i, j in ((1, 2), (2, 0), (0, 1))], axis=-1
    ) / 2  # fmt: skip
    sine = np.linalg.norm(skew, axis=1)
    return skew, sine, np.arctan2(sine, (np.trace(rotation, axis1=1, axis2=2) - 1) / 2)


def quaternion(rotation) -> np.ndarray:
    """Return w, x, y, z of one rotation (3, 3), w >= 0, right to some EPS at any angle; half turns have either sign.

    It is the row of the largest component in the matrix of products of the components (S. Shepperd, 1978).
    """
    products = np.empty((4, 4))
    trace = np.trace(rotation)
    products[0, 0] = 1 + trace
    products[0, 1:] = products[1:, 0] = [rotation[i][j] - rotation[j][i] for i, j in ((2, 1), (0, 2), (1, 0))]
    products[1:, 1:] = rotation + rotation.T + (1 - trace) * np.eye(3)
    row = products[np.argmax(np.diag(products))]
    return row / np.linalg.norm(row) * np.copysign(1.0, row[0])


def half_turn_vector(rotation) -> np.ndarray:
    """Return axis times angle, (3,), of one rotation (3, 3), right to some EPS at any angle up to a half turn."""
    w, *axis = quaternion(rotation)
    sine = np.linalg.norm(axis)
    return np.asarray(axis) * (2 * np.arctan2(sine, w) / sine if sine > 0 else 2.0)


def rotation(vector) -> np.ndarray:
    """Return the rotations (n, 3, 3) of rotation vectors (Rodrigues)."""
    angle = np.linalg.norm(vector, axis=1)[:, None, None]
    x, y, z = vector.T
    zero = np.zeros_like(x)
    cross = np.stack((zero, -z, y, z, zero, -x, -y, x, zero), axis=-1).reshape(-1, 3, 3)
    half = angle / 2
    return np.eye(3) + np.sinc(angle / np.pi) * cross + np.sinc(half / np.pi) ** 2 / 2 * (cross @ cross)


def from_quaternion(components) -> np.ndarray:
    """Return the rotation (3, 3) of a quaternion w, x, y, z of any length but 0, right to some EPS."""
    w, x, y, z = np.asarray(components) / np.linalg.norm(components)
    return np.array((
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    ))  # fmt: skip
