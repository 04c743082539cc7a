"""The reference paper, whole: every experiment run again, every figure drawn, every claim checked (`masonry paper`)."""
