"""Cracks as pictures: `crack_lines.py` finds, `crack_style.py` draws them; `crack_picture.py` sets out cracks.png."""
