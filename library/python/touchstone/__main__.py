"""python3 -m touchstone BODY BODY: what is true of two bodies, as JSON with certificates.

For example: python3 -m touchstone 'box 1 1 1' 'cylinder 0.5 2 at 0 0 3.5'
"""
import json
import sys

from . import Error, answer


def main() -> int:
    if len(sys.argv) != 3 or "-h" in sys.argv or "--help" in sys.argv:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    try:
        print(json.dumps(answer(sys.argv[1], sys.argv[2]), indent=1))
    except Error as e:
        print(f"touchstone: {e}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
