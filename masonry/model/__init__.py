"""The arrays that a step runs on, in SI units: blocks, contacts, loads, supports, the stable time step."""
