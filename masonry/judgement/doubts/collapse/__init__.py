"""The factor of a load that grew until something fell, and the branch behind its collapse."""
