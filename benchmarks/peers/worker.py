"""Another program's steps, asked for over a pipe: its worker runs in its own Python and only between our own rounds."""

import json
import os
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).parent


class Absent(Exception):
    """The other program is not installed, or does not run here."""


class Worker:
    """A worker that is ready; `says` is what it told of itself."""

    def __init__(self, command: list[str], script: str, kind: str) -> None:
        self.words = [*command, str(HERE / script), kind]
        one = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")
        bare = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        self.complaint = tempfile.TemporaryFile("w+")  # noqa: SIM115 - closed with the worker
        try:
            self.process = subprocess.Popen(
                self.words,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self.complaint,
                text=True,
                env=bare | one,
            )
        except OSError as error:
            raise Absent(f"{command[0]}: {error.strerror}") from None
        self.says = json.loads(self._answer())

    def seconds(self, steps: int) -> float:
        """Seconds of processor that some steps took."""
        assert self.process.stdin is not None
        self.process.stdin.write(f"{steps}\n")
        self.process.stdin.flush()
        return float(self._answer())

    def close(self) -> None:
        """End the worker: it stops when its input does."""
        assert self.process.stdin is not None
        self.process.stdin.close()
        self.process.terminate()
        self.process.wait()
        self.complaint.close()

    def _answer(self) -> str:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            if line.startswith("PEER "):
                return line[5:]
        code = self.process.wait()
        self.complaint.seek(0)
        last = [line.strip() for line in self.complaint if line.strip()][-1:]
        raise Absent(f"{self.words[0]} ended with code {code}: {' '.join(last) or 'no word of why'}")
