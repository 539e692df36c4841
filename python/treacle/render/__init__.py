# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) the Treacle authors
"""Pictures and films of runs, for scripts/render.py and scripts/gallery.

    from treacle import Run
    from treacle.render.pictures import Options, draw

    run = Run("results/column")
    draw(run, run.frames[-1:], Options(colour="speed"))    # results/column/pictures/*.png

Pictures of runs in three dimensions need VTK and a display, or xvfb-run."""
