"""What all tests start from."""

import signal

if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:  # as in what a script starts in the background
    signal.signal(signal.SIGINT, signal.default_int_handler)
