"""`python -m groebot` is the command `groebot`."""

import sys

from ._command import main

sys.exit(main())
