"""Many runs of a scene: `masonry sweep`, and the engine that runs a list of jobs and keeps what is done."""
