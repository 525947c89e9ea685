// The sliders between two drawings.
for (const slider of document.querySelectorAll('.cut input')) {
    const stage = slider.closest('.compare').querySelector('.stage');
    const cut = () => stage.style.setProperty('--cut', `${slider.value}%`);
    slider.addEventListener('input', cut);
    cut();
}
