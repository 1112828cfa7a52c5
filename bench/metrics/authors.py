# authors.py TEST REFERENCE TIMES: the least CPU seconds and seconds of the authors' ColorVideoVDP on
# the processor, after one call to warm up, and the JOD.
import sys
import time

import imageio.v2 as imageio
import pycvvdp
import torch

test, reference = (imageio.imread(path)[:, :, :3] for path in sys.argv[1:3])
metric = pycvvdp.cvvdp(display_name="standard_fhd", device=torch.device("cpu"))
cpu = wall = float("inf")
for attempt in range(int(sys.argv[3]) + 1):
    clock, start = time.process_time(), time.perf_counter()
    jod, _ = metric.predict(test, reference, dim_order="HWC")
    if attempt > 0:
        cpu = min(cpu, time.process_time() - clock)
        wall = min(wall, time.perf_counter() - start)
print(f"{cpu:.4f} {wall:.4f} {float(jod):.5f}")
