{
  const all = document.getElementById("animation"), slider = all.querySelector("input"), button = all.querySelector("button");
  const figures = [...all.querySelectorAll("figure")].map(figure => [...figure.querySelectorAll(".frame")]);
  const show = () => {
    figures.forEach(frames => frames.forEach((frame, k) => { frame.hidden = k != slider.value; }));
    all.querySelector("output").textContent = figures[0][slider.value].dataset.time;
  };
  let timer = 0;
  const stop = () => { clearInterval(timer); timer = 0; button.textContent = "Play"; };
  const step = () => { slider.value = (Number(slider.value) + 1) % figures[0].length; show(); };
  slider.oninput = () => { stop(); show(); };
  button.onclick = () => { if (timer) { stop(); } else { timer = setInterval(step, 200); button.textContent = "Stop"; } };
}
